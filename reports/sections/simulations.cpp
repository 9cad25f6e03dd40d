#include "reports/sections/sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "reports/text/json.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

using Row = std::vector<std::string>;

/// Totals and extremes over the steps of a simulation.
struct Whole {
  std::uint64_t steps = 0;
  SimulatedStep sum, last;
  std::uint64_t most_tangled = 0, most_picojoules = 0;
  std::uint64_t subject_ns = 0;                ///< the time that the subject took for all its answers
  std::optional<std::uint64_t> first_tangled;  ///< the number of the first step with tangles

  void add(std::uint64_t number, const SimulatedStep& step) {
    ++steps;
    last = step;
    most_picojoules = std::max(most_picojoules, step.picojoules);
    SimulatedStep counts = step;
    counts.picojoules = 0;  // a sum of the steps' energies means nothing
    sum.merge(counts);
    most_tangled = std::max(most_tangled, step.tangled);
    if (step.tangled > 0 && !first_tangled) first_tangled = number;
  }
};

Row row(const std::string& subject, const Whole& whole) {
  const auto joules = [](std::uint64_t pico) {
    return fmt::format("{:.3g} J", 1e-12 * static_cast<double>(pico));
  };
  const auto milliseconds = [&](std::uint64_t ns) {
    return fmt::format("{:.3g} ms", 1e-6 * static_cast<double>(ns) / static_cast<double>(whole.steps));
  };
  return {subject,
          with_separators(whole.steps),
          with_separators(whole.sum.rounds),
          with_separators(whole.sum.queries),
          with_separators(whole.sum.unanswered),
          with_separators(whole.sum.positives),
          with_separators(whole.sum.collisions),
          with_separators(whole.sum.false_negatives),
          with_separators(whole.sum.false_positives),
          with_separators(whole.sum.unresolved),
          with_separators(whole.most_tangled),
          whole.first_tangled ? with_separators(*whole.first_tangled) : "-",
          with_separators(whole.last.tangled),
          joules(whole.most_picojoules),
          joules(whole.last.picojoules),
          milliseconds(whole.sum.solver_ns),
          milliseconds(whole.subject_ns)};
}

}  // namespace

std::string simulation_tables(const Statistics& statistics) {
  std::map<std::string, std::map<std::string, Whole>> scenes;
  for (const auto& [key, step] : statistics.simulated) scenes[key.family][key.subject].add(key.step, step);
  for (const auto& [key, counts] : statistics.counts)
    if (const auto scene = scenes.find(key.family); scene != scenes.end())
      if (const auto whole = scene->second.find(key.subject); whole != scene->second.end())
        whole->second.subject_ns += counts.times.nanoseconds;
  std::string text;
  for (const auto& [scene, subjects] : scenes) {
    std::vector<Row> rows{{scene, "steps", "rounds", "answered", "unanswered", "reported", "collisions",
                           "missed", "false pos.", "unresolved", "tangled: most", "first in step",
                           "at the end", "energy: most", "at the end", "a step: solver", "CCD"}};
    for (const auto& [subject, whole] : subjects) rows.push_back(row(subject, whole));
    text += "\n" + columns(rows, 1);
  }
  if (!text.empty())
    text +=
        "tangled: pairs of an edge and a triangle that pass through each other; unresolved: pairs that were "
        "still "
        "reported when a step ended;\nunanswered: pairs that the subject does not decide, or gave no answer "
        "about\n";
  return text;
}

nlohmann::ordered_json simulations_json(const Statistics& statistics) {
  auto json = nlohmann::ordered_json::object();
  for (const auto& [key, step] : statistics.simulated) {
    auto& lists = json[key.family][key.subject];
    lists["step"].push_back(key.step);
    for_each_counter<SimulatedStep>([&lists, &counts = step](const auto& counter) {
      lists[std::string(counter.json_key)].push_back(counts.*counter.member);
    });
  }
  return json;
}

}  // namespace nearmiss
