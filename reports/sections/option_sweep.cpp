#include "reports/sections/option_sweep.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <vector>

#include "reports/sections/counts_json.hpp"
#include "reports/sections/time_table.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

/// A subject's place in the sweep of one of its options.
struct OptionStep {
  std::string pattern;
  double value;
};

/// A step for each option of the subject that is a number.
std::vector<OptionStep> steps_of(std::string_view subject) {
  std::vector<OptionStep> steps;
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

std::vector<std::string> row_of(QueryClass of, double value, const Counts& counts) {
  const auto shown = [](double error) { return fmt::format("{:.2g}", error); };
  return {std::string(name(of)),
          fmt::format("{:.6g}", value),
          with_separators(counts.queries),
          with_separators(counts.collisions),
          with_separators(counts.false_negatives),
          late_times(counts),
          with_separators(counts.stuck),
          with_separators(counts.unknown()),
          with_separators(counts.faults_total()),
          shown(counts.early_quantile(0.5).to),
          shown(counts.early_quantile(0.99).to),
          shown(counts.max_early()),
          with_separators(counts.false_positives),
          shown(counts.false_positive_rate()),
          whole_ns(counts.times.ns_per_query())};
}

}  // namespace

std::map<std::string, OptionSweep> option_sweeps(const Statistics& statistics) {
  std::map<std::string, OptionSweep> found;
  for (const auto& [key, counts] : statistics.counts)
    for (const OptionStep& step : steps_of(key.subject))
      found[step.pattern][{class_of(key.family), step.value}].add(key.family, counts);
  std::erase_if(found, [](const auto& each) { return has_one_value(each.second); });
  return found;
}

std::string option_sweep_tables(const Statistics& statistics) {
  std::string text;
  for (const auto& [pattern, sweep] : option_sweeps(statistics)) {
    std::vector<std::vector<std::string>> rows{{"class", "*", "queries", "collisions", "false neg.", "late",
                                                "stuck", "unknown", "no answer", "early: median", "99 %",
                                                "most", "false pos.", "rate", "ns/query"}};
    for (const auto& [key, sum] : sweep) rows.push_back(row_of(key.first, key.second, sum.counts));
    text += fmt::format("\n{}\n{}", pattern, columns(rows, 1));
  }
  return text;
}

nlohmann::ordered_json option_sweeps_json(const Statistics& statistics) {
  auto json = nlohmann::ordered_json::object();
  for (const auto& [pattern, sweep] : option_sweeps(statistics)) {
    auto& steps = json[pattern];
    for (const auto& [key, sum] : sweep) {
      steps.push_back({{"class", name(key.first)}, {"value", key.second}});
      steps.back().update(rates_json(sum.counts, sum.is_sample));
      steps.back()["without_answer"] = sum.counts.faults_total();
    }
  }
  return json;
}

}  // namespace nearmiss
