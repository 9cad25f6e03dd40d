#include "reports/sections/sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "corpus/query_text.hpp"
#include "reports/sections/measures.hpp"
#include "reports/statistics/family.hpp"
#include "reports/text/json.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

/// The first cell of the row for each PairFate. The cell says what becomes of a pair.
constexpr std::array<std::string_view, pair_fate_count> explanations{
    "swept boxes do not meet: no plane, no polynomial", "share a vertex",
    "at rest relative to each other: a static test", "in relative translation: a linear test", "asked"};

/// The pairs of all steps of a scene, and what became of these pairs.
struct ScenePairs {
  std::array<Funnel, kinds_of_meshes.size()> funnels;  ///< pairs of each kind
  std::size_t steps = 0;
  std::map<std::string, std::array<Counts, kinds_of_meshes.size()>> subjects;
  std::array<OracleCounts, kinds_of_meshes.size()> oracle;
};

std::map<std::string, ScenePairs> scenes_of(const Statistics& statistics) {
  const auto number = [](Kind kind) { return static_cast<std::size_t>(kind); };
  std::map<std::string, ScenePairs> scenes;
  for (const auto& [key, funnel] : statistics.funnels) {
    const auto& [step, kind] = key;
    ScenePairs& scene = scenes[scene_of(step)];
    scene.funnels[number(kind)].merge(funnel);
    if (kind == kinds.front()) ++scene.steps;
  }
  for (const auto& [key, counts] : statistics.counts)
    if (statistics.funnels.contains({key.family, key.kind}))
      scenes[scene_of(key.family)].subjects[key.subject][number(key.kind)].merge(counts);
  for (const auto& [key, counts] : statistics.oracle)
    if (statistics.funnels.contains({key.second, key.first}))
      scenes[scene_of(key.second)].oracle[number(key.first)].merge(counts);
  return scenes;
}

using Row = std::vector<std::string>;

/// A row of a table. For each kind, the row has a number from `parts`, and this number as a percentage of the
/// number in `all`.
Row row(std::string_view what, std::array<std::uint64_t, 2> parts, std::array<std::uint64_t, 2> all) {
  Row cells{std::string(what)};
  for (std::size_t i = 0; i < 2; ++i) {
    cells.push_back(with_separators(parts[i]));
    cells.push_back(percent(parts[i], all[i]));
  }
  return cells;
}

/// Adds rows that say how much work the asked pairs need: for the oracle, and for subjects that say which of
/// their tests rejected a pair.
void add_needs(const ScenePairs& scene, std::array<std::uint64_t, 2> asked, std::vector<Row>& rows) {
  static const std::map<Rejection, std::string_view> left_out{
      {Rejection::planes, "planes separate the primitives, nothing else is computed"},
      {Rejection::apart, "too far apart for a root"},
      {Rejection::no_root, "the cubic has no root, no test is needed"},
      {Rejection::culled, "vertex-edge tests are culled"}};
  for (const auto& subject : scene.subjects) {
    const std::string& name = subject.first;
    const auto& counts = subject.second;
    const auto by = [&](Rejection rejection, std::size_t i) {
      return counts[i].rejected_by[static_cast<std::size_t>(rejection)];
    };
    std::array<std::uint64_t, 2> rest = asked;
    std::vector<Row> own;
    for (const auto& [rejection, what] : left_out) {
      const std::array<std::uint64_t, 2> parts{by(rejection, 0), by(rejection, 1)};
      if (parts[0] + parts[1] == 0) continue;
      own.push_back(row(fmt::format("  {}: {}", name, what), parts, asked));
      for (std::size_t i = 0; i < 2; ++i) rest[i] -= parts[i];
    }
    if (own.empty()) continue;
    own.push_back(row(fmt::format("  {}: all tests, or reported", name), rest, asked));
    rows.insert(rows.end(), own.begin(), own.end());
  }
  const auto undecided = [&](std::size_t i) {
    return scene.oracle[i].by_stage[static_cast<std::size_t>(FilterStage::undecided)];
  };
  rows.push_back(row("  oracle: the filter decides, exact arithmetic is not needed",
                     {scene.oracle[0].queries - undecided(0), scene.oracle[1].queries - undecided(1)},
                     asked));
}

}  // namespace

std::string funnel_tables(const Statistics& statistics) {
  std::string text;
  for (const auto& [name, scene] : scenes_of(statistics)) {
    const auto& [vt, ee] = scene.funnels;
    const std::array<std::uint64_t, 2> all{vt.all(), ee.all()};
    std::vector<Row> rows{{counted(scene.steps, "step", "steps"), "vertex-triangle", "", "edge-edge", ""}};
    rows.push_back(row("all pairs", all, all));
    for (std::size_t i = 0; i < pair_fate_count; ++i) {
      const bool last = i + 1 == pair_fate_count;
      if (last) rows.push_back(row("  of these collide", {vt.touching, ee.touching}, all));
      rows.push_back(
          row((last ? "= " : "- ") + std::string(explanations[i]), {vt.pairs[i], ee.pairs[i]}, all));
    }
    if (!scene.subjects.empty()) add_needs(scene, {vt[PairFate::asked], ee[PairFate::asked]}, rows);
    text += fmt::format("\n{}\n{}", name, columns(rows, 1));
    if (vt.all() == 0) text += "vertex-triangle: there are no triangles, or no vertices\n";
    if (ee.all() == 0) text += "edge-edge: there are fewer than two edges\n";
    const auto seconds = [](std::uint64_t ns) { return 1e-9 * static_cast<double>(ns); };
    text +=
        fmt::format("time of one core: {:.3g} s to find the pairs, {:.3g} s to decide what becomes of them\n",
                    seconds(vt.finding_ns + ee.finding_ns), seconds(vt.deciding_ns + ee.deciding_ns));
  }
  return text;
}

nlohmann::ordered_json funnels_json(const Statistics& statistics) {
  auto json = nlohmann::ordered_json::object();
  for (const auto& [key, funnel] : statistics.funnels) {
    json[key.first][std::string(short_name(key.second))] = funnel_json(funnel);
  }
  return json;
}

namespace {

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
  const SimulatedStep& sum = whole.sum;
  Row cells{subject};
  for (const std::uint64_t number :
       {whole.steps, sum.rounds, sum.queries, sum.unanswered, sum.positives, sum.collisions,
        sum.false_negatives, sum.false_positives, sum.unresolved, whole.most_tangled})
    cells.push_back(with_separators(number));
  cells.insert(cells.end(),
               {whole.first_tangled ? with_separators(*whole.first_tangled) : "-",
                with_separators(whole.last.tangled), joules(whole.most_picojoules),
                joules(whole.last.picojoules), milliseconds(sum.solver_ns), milliseconds(whole.subject_ns)});
  return cells;
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
