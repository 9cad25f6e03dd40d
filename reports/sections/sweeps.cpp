#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reports/sections/measures.hpp"
#include "reports/sections/sections.hpp"
#include "reports/statistics/confidence.hpp"
#include "reports/statistics/family.hpp"
#include "reports/text/json.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

using nlohmann::ordered_json;

namespace {

/// The counters of a subject, summed over all kinds, for each value of the parameter that a sweep varies.
using Sweep = std::map<double, CountsSum>;

/// The counters, summed over all kinds, for each class of families and each value of a subject's option.
using OptionSweep = std::map<std::pair<QueryClass, double>, CountsSum>;

/// Two neighbouring values of an option, and the proportion of missed collisions at each of them.
struct Cliff {
  QueryClass of{};  ///< class of the families
  double value = 0, next = 0;
  Proportion missed, missed_next;
};

/// A step of a sweep: the name of the swept family or option, and the value that it has in this step.
struct Step {
  std::string of;
  double value;
};

/// The step of a family "NAME@VALUE" or "NAME@VALUE~SEPARATION"; nothing for other families.
std::optional<Step> step_of_family(std::string_view name) {
  FamilyName of(name);
  const auto value = of.value ? number_in(*of.value) : std::nullopt;
  of.value.reset();
  return value ? std::optional(Step{of.text(), *value}) : std::nullopt;
}

/// "NAME@x" or "NAME@x~SEPARATION"
std::string title_of_sweep(std::string_view family) {
  FamilyName of(family);
  of.value = "x";
  return of.text();
}

/// A step for each of the subject's options that have a number as value.
std::vector<Step> steps_of_options(std::string_view subject) {
  std::vector<Step> steps;
  for (auto at = subject.find(':'); at != std::string_view::npos; at = subject.find(':', at + 1)) {
    const std::string_view option = subject.substr(at, subject.find(':', at + 1) - at);
    const auto key = option.substr(0, option.find('=') + 1);
    const auto value = key.empty() ? std::nullopt : number_in(option.substr(key.size()));
    if (!value) continue;
    const auto before = subject.substr(0, at + key.size());
    const auto after = subject.substr(at + option.size());
    steps.push_back({fmt::format("{}*{}", before, after), *value});
  }
  return steps;
}

bool has_one_value(const OptionSweep& sweep) {
  std::set<double> values;
  for (const auto& [key, sum] : sweep) values.insert(key.second);
  return values.size() == 1;
}

/// The sweeps in a campaign, by family (NAME or NAME~SEPARATION) and subject. A sweep is a set of families
/// NAME@VALUE, or NAME@VALUE~SEPARATION, with at least two values.
std::map<std::pair<std::string, std::string>, Sweep> sweeps(const Statistics& statistics) {
  std::map<std::pair<std::string, std::string>, Sweep> found;
  for (const auto& [key, counts] : statistics.counts)
    if (const auto step = step_of_family(key.family))
      found[{step->of, key.subject}][step->value].add(key.family, counts);
  std::erase_if(found, [](const auto& each) { return each.second.size() < 2; });
  return found;
}

/// The sweeps of options in a campaign, by pattern. Subjects NAME:KEY=NUMBER with at least two different
/// numbers are a sweep with the pattern NAME:KEY=*.
std::map<std::string, OptionSweep> option_sweeps(const Statistics& statistics) {
  std::map<std::string, OptionSweep> found;
  for (const auto& [key, counts] : statistics.counts)
    for (const Step& step : steps_of_options(key.subject))
      found[step.of][{class_of(key.family), step.value}].add(key.family, counts);
  std::erase_if(found, [](const auto& each) { return has_one_value(each.second); });
  return found;
}

Proportion missed(const CountsSum& sum) { return {sum.counts.false_negatives, sum.counts.collisions}; }

double difference(const Cliff& cliff) { return std::abs(cliff.missed.rate() - cliff.missed_next.rate()); }

/// The neighbouring values of the option between which the rate of misses changes most. Looks only at the
/// least exotic class in which the rate changes by more than chance explains. Returns nothing if there is no
/// such class.
std::optional<Cliff> cliff_of(const OptionSweep& sweep) {
  constexpr double improbable = 1e-3;
  std::optional<Cliff> best;
  for (auto at = sweep.begin(); at != sweep.end() && std::next(at) != sweep.end(); ++at) {
    const auto& [key, sum] = *at;
    const auto& [next, next_sum] = *std::next(at);
    if (next.first != key.first || (best && best->of != key.first)) continue;
    if (key.second < 0 && next.second >= 0)
      // for many options, a negative value means "no limit", so it is not a neighbour of the smallest other
      // value
      continue;
    const Cliff cliff{key.first, key.second, next.second, missed(sum), missed(next_sum)};
    const bool is_there = cliff.missed.total > 0 && cliff.missed_next.total > 0 &&
                          fisher_test(cliff.missed_next, cliff.missed).either() < improbable;
    if (is_there && (!best || difference(cliff) > difference(*best))) best = cliff;
  }
  return best;
}

/// "cliff: of the collisions in ordinary families, 30 % are missed at 1000, and none at 10000"
std::string to_text(const Cliff& cliff) {
  const auto share = [](const Proportion& part) {
    return part.count == 0 ? std::string("none") : percent(part.count, part.total);
  };
  return fmt::format("cliff: of the collisions in {} families, {} are missed at {:.6g}, and {} at {:.6g}",
                     name(cliff.of), share(cliff.missed), cliff.value, share(cliff.missed_next), cliff.next);
}

}  // namespace

std::string sweep_tables(const Statistics& statistics) {
  const auto as_text = [](double value) { return fmt::format("{:.6g}", value); };
  const auto cells = [&](double value) { return std::vector{as_text(value)}; };
  const auto cells_of_option = [&](const std::pair<QueryClass, double>& key) {
    return std::vector{std::string(name(key.first)), as_text(key.second)};
  };
  std::string text;
  for (const auto& [key, sweep] : sweeps(statistics))
    text += fmt::format("\n{} along {}\n{}", key.second, title_of_sweep(key.first),
                        table(sweep, {"x"}, cells,
                              {"queries", "collisions", "false_negatives", "false_positives",
                               "false_positive_rate", "max_fp_distance_over_bound", "ns_per_query"},
                              0));
  for (const auto& [pattern, sweep] : option_sweeps(statistics)) {
    text += fmt::format("\n{}\n{}", pattern,
                        table(sweep, {"class", "*"}, cells_of_option,
                              {"queries", "collisions", "false_negatives", "late", "stuck", "unknown",
                               "without_answer", "median_early", "q99_early", "max_early", "false_positives",
                               "false_positive_rate", "ns_per_query"},
                              1));
    if (const auto cliff = cliff_of(sweep)) text += to_text(*cliff) + "\n";
  }
  return text;
}

ordered_json sweeps_json(const Statistics& statistics) {
  const MeasureKeys shown{"queries",
                          "collisions",
                          "false_negatives",
                          "false_negative_rate",
                          "false_positives",
                          "false_positive_rate",
                          "max_fp_distance_over_bound",
                          "bound_of_distances",
                          "ns_per_query"};
  auto json = ordered_json::object();
  for (const auto& [key, sweep] : sweeps(statistics)) {
    auto& steps = json[key.first][key.second];
    for (const auto& [value, sum] : sweep) {
      steps.push_back({{"value", value}});
      add_measures(steps.back(), shown, sum);
    }
  }
  return json;
}

ordered_json cliffs_json(const Statistics& statistics) {
  auto json = ordered_json::array();
  for (const auto& [pattern, sweep] : option_sweeps(statistics))
    if (const auto cliff = cliff_of(sweep))
      json.push_back({{"pattern", pattern},
                      {"class", name(cliff->of)},
                      {"value", cliff->value},
                      {"next", cliff->next},
                      {"false_negative_rate", cliff->missed.rate()},
                      {"false_negative_rate_next", cliff->missed_next.rate()},
                      {"text", to_text(*cliff)}});
  return json;
}

ordered_json option_sweeps_json(const Statistics& statistics) {
  auto json = ordered_json::object();
  for (const auto& [pattern, sweep] : option_sweeps(statistics)) {
    auto& steps = json[pattern];
    for (const auto& [key, sum] : sweep) {
      steps.push_back({{"class", name(key.first)}, {"value", key.second}});
      steps.back().update(rates_json(sum));
      add_measures(steps.back(), {"without_answer"}, sum);
    }
  }
  return json;
}

}  // namespace nearmiss
