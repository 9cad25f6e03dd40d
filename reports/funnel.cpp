#include "reports/funnel.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "corpus/query_text.hpp"
#include "reports/statistics.hpp"
#include "reports/summary.hpp"

namespace nearmiss {

namespace {

/// The scene of "scene:NAME#STEP".
std::string scene_of(const std::string& step) { return step.substr(0, step.rfind('#')); }

/// What a line says of a fate.
constexpr std::array<std::string_view, pair_fate_count> explanations{
    "swept boxes do not meet", "share a vertex", "at rest relative to each other: a static test",
    "in relative translation: a linear test", "asked"};

std::string percent(std::uint64_t part, std::uint64_t all) {
  return all == 0 ? "" : fmt::format("{:.3g} %", 100 * static_cast<double>(part) / static_cast<double>(all));
}

}  // namespace

std::string funnel_tables(const Statistics& statistics) {
  struct Sum {
    std::array<Funnel, kinds.size()> of;
    std::size_t steps = 0;
  };
  std::map<std::string, Sum> scenes;
  for (const auto& [key, funnel] : statistics.funnels) {
    Sum& sum = scenes[scene_of(key.first)];
    sum.of[static_cast<std::size_t>(key.second)].merge(funnel);
    if (key.second == Kind::vertex_triangle) ++sum.steps;
  }
  std::string text;
  for (const auto& [name, sum] : scenes) {
    const auto& [vt, ee] = sum.of;
    const auto row = [&](std::string_view what, std::uint64_t of_vt, std::uint64_t of_ee) {
      return std::vector<std::string>{std::string(what), with_separators(of_vt), percent(of_vt, vt.all()),
                                      with_separators(of_ee), percent(of_ee, ee.all())};
    };
    std::vector<std::vector<std::string>> rows{
        {counted(sum.steps, "step", "steps"), "vertex-triangle", "", "edge-edge", ""}};
    rows.push_back(row("all pairs", vt.all(), ee.all()));
    for (std::size_t i = 0; i < pair_fate_count; ++i)
      rows.push_back(row((i + 1 == pair_fate_count ? "= " : "- ") + std::string(explanations[i]), vt.pairs[i],
                         ee.pairs[i]));
    rows.push_back(row("of those not asked collide", vt.touching, ee.touching));
    text += fmt::format("\n{}\n{}", name, columns(rows, 1));
    if (vt.all() == 0) text += "vertex-triangle: there are no triangles, or no vertices\n";
    if (ee.all() == 0) text += "edge-edge: there are no two edges\n";
    const auto seconds = [](std::uint64_t ns) { return 1e-9 * static_cast<double>(ns); };
    text += fmt::format("pairs found in {:.3g} s, fates told in {:.3g} s\n",
                        seconds(vt.finding_ns + ee.finding_ns), seconds(vt.deciding_ns + ee.deciding_ns));
  }
  return text;
}

nlohmann::ordered_json funnels_json(const Statistics& statistics) {
  auto json = nlohmann::ordered_json::object();
  for (const auto& [key, funnel] : statistics.funnels) {
    auto& each = json[key.first][std::string(short_name(key.second))];
    each["all"] = funnel.all();
    for (std::size_t i = 0; i < pair_fate_count; ++i) each[std::string(pair_fate_names[i])] = funnel.pairs[i];
    each["touching"] = funnel.touching;
    each["times"] = {{"finding_ns", funnel.finding_ns}, {"deciding_ns", funnel.deciding_ns}};
  }
  return json;
}

}  // namespace nearmiss
