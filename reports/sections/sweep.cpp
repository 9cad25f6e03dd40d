#include "reports/sections/sweep.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "reports/sections/counts_json.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

/// A family and the value of its parameter.
struct SweepStep {
  std::string family;
  double value;
};

/// The step of a family "NAME@VALUE"; nothing for other families.
std::optional<SweepStep> step_of(std::string_view name) {
  const auto at = name.rfind('@');
  if (at == std::string_view::npos) return std::nullopt;
  const auto value = number_in(name.substr(at + 1));
  return value ? std::optional(SweepStep{std::string(name.substr(0, at)), *value}) : std::nullopt;
}

}  // namespace

std::map<std::pair<std::string, std::string>, Sweep> sweeps(const Statistics& statistics) {
  std::map<std::pair<std::string, std::string>, Sweep> found;
  for (const auto& [key, counts] : statistics.counts)
    if (const auto step = step_of(key.family)) found[{step->family, key.subject}][step->value].merge(counts);
  std::erase_if(found, [](const auto& each) { return each.second.size() < 2; });
  return found;
}

std::string sweep_tables(const Statistics& statistics) {
  std::string text;
  for (const auto& [key, sweep] : sweeps(statistics)) {
    std::vector<std::vector<std::string>> rows{
        {"x", "queries", "collisions", "false neg.", "false pos.", "rate", "max dist/bound", "ns/query"}};
    for (const auto& [value, c] : sweep)
      rows.push_back({fmt::format("{:.6g}", value), with_separators(c.queries), with_separators(c.collisions),
                      with_separators(c.false_negatives), with_separators(c.false_positives),
                      fmt::format("{:.2g}", c.false_positive_rate()),
                      marked_fraction_of_bound(c.max_ratio(), c.distance_unit()),
                      whole_ns(c.times.ns_per_query())});
    text += fmt::format("\n{} along {}@x\n{}", key.second, key.first, columns(rows, 0));
  }
  return text;
}

nlohmann::ordered_json sweeps_json(const Statistics& statistics) {
  auto json = nlohmann::ordered_json::object();
  for (const auto& [key, sweep] : sweeps(statistics)) {
    auto& steps = json[key.first][key.second];
    for (const auto& [value, c] : sweep)
      steps.push_back({{"value", value},
                       {"queries", c.queries},
                       {"collisions", c.collisions},
                       {"false_negatives", c.false_negatives},
                       {"false_negative_rate", c.false_negative_rate()},
                       {"false_positives", c.false_positives},
                       {"false_positive_rate", c.false_positive_rate()},
                       {"max_fp_distance_over_bound", c.max_ratio()},
                       {"bound_of_distances", name(c.distance_unit())},
                       {"ns_per_query", or_null(c.times.ns_per_query())}});
  }
  return json;
}

}  // namespace nearmiss
