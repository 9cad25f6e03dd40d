#include "tools/paper/claims.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "ccd/wang/tolerances.hpp"
#include "fuzz/studies/random_pairs.hpp"
#include "reports/text/json.hpp"
#include "reports/text/text.hpp"

namespace nearmiss::tools::paper {

namespace {

constexpr std::array<std::string_view, 5> names{"holds", "holds with a condition", "does not hold",
                                                "a question, answered", "cannot be measured here"};

using nlohmann::ordered_json;
using enum Judgement;

Judgement holds_if(bool it_does) { return it_does ? holds : does_not_hold; }
Judgement with_condition_if(bool it_does) { return it_does ? holds_with_condition : does_not_hold; }

std::uint64_t count(const ordered_json& results, const std::string& subject, const std::string& key) {
  std::uint64_t sum = 0;
  for (const auto& kind : results.at("subjects").at(subject)) sum += kind.at(key).get<std::uint64_t>();
  return sum;
}

double share(const ordered_json& results, const std::string& subject, const std::string& key) {
  return static_cast<double>(count(results, subject, key)) /
         static_cast<double>(count(results, subject, "queries"));
}

/// How many queries of a kind a subject rejected for the reason `why`.
std::uint64_t rejected(const ordered_json& results, const std::string& subject, const std::string& kind,
                       const char* why) {
  return results.at("subjects").at(subject).at(kind).at("rejected_by").value(why, std::uint64_t{0});
}

/// How many queries of a kind reached the subject's vertex-edge tests.
std::uint64_t vertex_edge_tests(const ordered_json& results, const std::string& subject,
                                const std::string& kind) {
  const ordered_json& counts = results.at("subjects").at(subject).at(kind);
  std::uint64_t sum = rejected(results, subject, kind, "tests");
  for (const char* by : {"true_positives_by_stage", "false_positives_by_stage"})
    for (const char* stage : {"ve-end", "ve-minimum", "ve-equal", "ve-zero", "vv"})
      sum += counts.at(by).value(stage, std::uint64_t{0});
  return sum;
}

/// The run time of a subject divided by that of the first subject of the bench, for one kind and input.
double time_ratio(const ordered_json& results, const std::string& subject, const std::string& input,
                  const std::string& kind) {
  for (const auto& row : results.at("results"))
    if (row.at("subject") == subject && row.at("input") == input && row.at("kind") == kind)
      return row.at("ratio").get<double>();
  return std::nan("");
}

struct Ratios {
  double vt, ee;
  [[nodiscard]] bool are_at_most(double most) const { return vt <= most && ee <= most; }
  [[nodiscard]] bool are_at_least(double least) const { return vt >= least && ee >= least; }
};

Ratios time_ratios(const ordered_json& results, const std::string& subject, const std::string& input) {
  return {time_ratio(results, subject, input, "vt"), time_ratio(results, subject, input, "ee")};
}

/// The tolerances for a machine epsilon of 2^exponent, from nearmiss audit.
const ordered_json& tolerances(const ordered_json& audit, int exponent) {
  for (const auto& row : audit.at("tolerances"))
    if (row.at("epsilon_exponent") == exponent) return row;
  throw std::out_of_range(fmt::format("no tolerances for 2^{}", exponent));
}

/// The distance bound of the paper's closed forms for an epsilon of 2^exponent, in units of B, the size of
/// the pair.
double in_B(const ordered_json& audit, int exponent) {
  return tolerances(audit, exponent).at("paper_bound").get<double>() * std::exp2(exponent / 4.0);
}

constexpr std::uint64_t some_pairs = 50'000;

struct BothKinds {
  RandomPairs vt, ee;
};

BothKinds pairs_at(double speed, const Stop& stop) {
  return {count_random_pairs(Kind::vertex_triangle, speed, some_pairs, 1, stop),
          count_random_pairs(Kind::edge_edge, speed, some_pairs, 1, stop)};
}

/// The paper's claim of a small overhead holds if the ratio of run times is at most this number. The number
/// leaves room for the noise of a busy machine.
constexpr double small_overhead = 1.1;

std::string in_words(const Ratios& ratios) {
  return fmt::format("{:.2f} (vt) and {:.2f} (ee)", ratios.vt, ratios.ee);
}

constexpr std::array<std::string_view, 4> scenes{"knot", "cloths", "spikes", "hair"};

/// The values of the counter `key` in all steps of a simulation with a subject as its CCD.
const ordered_json& steps(const ordered_json& results, std::string_view scene, const std::string& subject,
                          const std::string& key) {
  return results.at("simulations").at(fmt::format("scene:sim:{}", scene)).at(subject).at(key);
}

std::uint64_t simulated(const ordered_json& results, std::string_view scene, const std::string& subject,
                        const std::string& key) {
  std::uint64_t sum = 0;
  for (const auto& step : steps(results, scene, subject, key)) sum += step.get<std::uint64_t>();
  return sum;
}

/// The increases of a counter in simulations with wang, compared with simulations with exact. `parts` has the
/// increase in each scene, as a fraction of the counter with exact. `text` has all increases in words.
struct Changes {
  std::vector<double> parts;
  std::string text;
};

Changes changes_with_wang(const Results& results, const std::string& key) {
  Changes changes;
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const auto with = [&](const char* subject) {
      return static_cast<double>(simulated(results[i], scenes[i], subject, key));
    };
    changes.parts.push_back(with("wang") / with("exact") - 1);
    texts.push_back(fmt::format("{} {:+.1f} %", scenes[i], 100 * changes.parts.back()));
  }
  changes.text = fmt::format("{}", fmt::join(texts, ", "));
  return changes;
}

// --- §1 and §6: safety ------------------------------------------------------------------------------------

Measured safe(const Results& results, const Stop& /*stop*/) {
  const ordered_json& all = results[0];
  std::uint64_t missed = 0;
  for (const char* subject : {"wang", "wang-eps", "wang-plain", "wang:float"})
    missed += count(all, subject, "false_negatives");
  return {fmt::format(
              "{} missed by wang, wang-eps, wang-plain and wang:float in {} collisions of all families, {} "
              "by basic. The proof needs operations that are rounded to nearest, each on its own",
              missed, with_separators(count(all, "wang", "collisions")),
              with_separators(count(all, "basic", "false_negatives"))),
          with_condition_if(missed == 0)};
}

Measured random_cases(const Results& results, const Stop& /*stop*/) {
  const ordered_json& all = results[0];
  const std::uint64_t missed = count(all, "wang", "false_negatives");
  return {
      fmt::format(
          "{} missed in {} queries with {} collisions, {} by basic (10 billion of them: reports/README.md)",
          missed, with_separators(count(all, "wang", "queries")),
          with_separators(count(all, "wang", "collisions")), count(all, "basic", "false_negatives")),
      holds_if(missed == 0)};
}

// --- §3 and §5: counts of random pairs ----------------------------------------------------------------------

Measured candidates(const Results& /*results*/, const Stop& stop) {
  const auto mean = [](const RandomPairs& pairs) {
    return static_cast<double>(pairs.candidates) / static_cast<double>(pairs.vertex_edge);
  };
  std::vector<std::string> means;
  bool always = true;
  bool sometimes = false;
  for (const double speed : {1.0, 0.5, 0.2, 0.01}) {
    const auto [vt, ee] = pairs_at(speed, stop);
    const double both = (mean(vt) + mean(ee)) / 2;
    const bool about_seven = both > 6 && both < 8;
    always = always && about_seven;
    sometimes = sometimes || about_seven;
    means.push_back(fmt::format("{:.1f} and {:.1f} with velocities in ±{}", mean(vt), mean(ee), speed));
  }
  return {fmt::format("vt and ee: {}; so the number depends on the motion", fmt::join(means, ", ")),
          always ? holds : with_condition_if(sometimes)};
}

Measured boxes(const Results& /*results*/, const Stop& stop) {
  const auto [vt, ee] = pairs_at(0.5, stop);
  const auto [vt1, ee1] = pairs_at(1, stop);
  const auto is_half = [](double part) { return part > 0.4 && part < 0.6; };
  const double vertex = vt.part(vt.boxes_meet);
  const double edge = ee.part(ee.boxes_meet);
  return {
      fmt::format(
          "with velocities in ±0.5, {:.2f} of the vertices and triangles and {:.2f} of the edges; {:.2f} and "
          "{:.2f} in ±1",
          vertex, edge, vt1.part(vt1.boxes_meet), ee1.part(ee1.boxes_meet)),
      is_half(vertex) && is_half(edge) ? holds : with_condition_if(is_half(vertex))};
}

Measured planes(const Results& /*results*/, const Stop& stop) {
  const auto [vt, ee] = pairs_at(0.5, stop);
  const auto [vt1, ee1] = pairs_at(1, stop);
  const double mean = (vt.part(vt.not_culled) + ee.part(ee.not_culled)) / 2;
  return {fmt::format("vt {:.2f}, ee {:.2f}, together {:.2f}, with velocities in ±0.5; {:.2f}, {:.2f} in ±1",
                      vt.part(vt.not_culled), ee.part(ee.not_culled), mean, vt1.part(vt1.not_culled),
                      ee1.part(ee1.not_culled)),
          holds_if(mean > 0.25 && mean < 0.36)};
}

Measured percent_of_edge(const Results& /*results*/, const Stop& stop) {
  const auto [vt, ee] = pairs_at(0.01, stop);
  const auto [vt1, ee1] = pairs_at(1, stop);
  const double of_B = 100 * PaperTolerances()(1.0).distance_bound();
  const auto of_edge = [&](const RandomPairs& pairs) {
    return of_B * pairs.bounds / static_cast<double>(pairs.queries);
  };
  return {
      fmt::format("{:.2f} % of B. B is about the longest edge only if vertices move slowly: {:.2f} % of it "
                  "with velocities in ±0.01, {:.2f} % in ±1 (means of vt and ee)",
                  of_B, (of_edge(vt) + of_edge(ee)) / 2, (of_edge(vt1) + of_edge(ee1)) / 2),
      with_condition_if(of_edge(vt) < 0.55 && of_edge(ee) < 0.55)};
}

// --- §4: constants, tolerances, bounds ----------------------------------------------------------------------

Measured constants(const Results& results, const Stop& /*stop*/) {
  int quoted = 0;
  int to_nearest = 0;
  int too_small = 0;
  for (const auto& row : results[0].at("constants")) {
    const bool is_ours = row.at("section").get<std::string>().find("ccd/") != std::string::npos;
    if (is_ours || row.at("quoted").is_null()) continue;
    ++quoted;
    to_nearest += row.at("needs_proof").get<bool>() ? 1 : 0;
    too_small += row.at("too_small").get<bool>() ? 1 : 0;
  }
  const bool have_room = tolerances(results[0], -52).at("paper_breaks").get<std::string>().empty();
  return {fmt::format("of {} constants that the paper states, {} are large enough by Theorem 4.1 or by a "
                      "derivation here, {} only for rounding to nearest, and {} are too small where end "
                      "points of edges are "
                      "beyond B. With what is proven in their place, the tolerances {} all constraints",
                      quoted, quoted - to_nearest - too_small, to_nearest, too_small,
                      have_room ? "satisfy" : "do not satisfy"),
          too_small == 0 && to_nearest == 0 ? holds : with_condition_if(have_room)};
}

Measured closed_forms(const Results& results, const Stop& /*stop*/) {
  const ordered_json& row = tolerances(results[0], -52);
  const auto breaks = row.at("paper_breaks").get<std::string>();
  return {fmt::format("{:.2f} B ε^¼; {}; the smallest tolerances give {:.2f} B ε^¼",
                      row.at("paper_bound").get<double>(),
                      breaks.empty() ? "all constraints hold" : "they break " + breaks,
                      row.at("tight_bound").get<double>()),
          holds_if(breaks.empty())};
}

Measured bound(const Results& results, const Stop& /*stop*/) {
  std::vector<std::string> farthest;
  double largest = 0;
  for (const auto& [tests, extreme] : results[0].at("tightness").items()) {
    const double value = extreme.at("value").is_null() ? 0 : extreme["value"].get<double>();
    farthest.push_back(fmt::format("{:.3f} by {} tests", value, tests));
    largest = std::max(largest, value);
  }
  return {
      fmt::format(
          "farthest false positive found, by its smallest distance in the step, in units of the bound: {}",
          fmt::join(farthest, ", ")),
      holds_if(largest <= 1)};
}

Measured order(const Results& results, const Stop& /*stop*/) {
  const double exponent = std::log2(in_B(results[0], -52) / in_B(results[0], -104)) / 52;
  return {fmt::format("the distance bound is proportional to ε^{:.3f}, as §4 has it", exponent),
          holds_if(std::abs(exponent - 1.0 / 3) < 0.01)};
}

Measured half_an_edge(const Results& results, const Stop& /*stop*/) {
  const ordered_json& row = tolerances(results[0], -23);
  const double closed = in_B(results[0], -23);
  double found = 0;
  for (const auto& kind : results[1].at("subjects").at("wang:float"))
    found = std::max(found, kind.at("max_fp_distance_over_bound").get<double>());
  return {
      fmt::format(
          "{:.2f} B by the closed forms; search finds {:.2f} B. With the paper's constants, the closed forms "
          "violate the constraint of the {} in float. The smallest tolerances give {:.2f} B",
          closed, found * closed, row.at("paper_breaks_as_printed").get<std::string>(),
          row.at("tight_bound_over_B").get<double>()),
      with_condition_if(found * closed > 0.4)};
}

Measured precisions(const Results& results, const Stop& /*stop*/) {
  const auto first_that_satisfy = [&](const char* key) {
    for (const auto& row : results[0].at("tolerances"))
      if (row.at(key).get<std::string>().empty()) return row.at("scalars").get<std::string>();
    return std::string("no precision");
  };
  return {
      fmt::format(
          "the bound goes as ε^¼: {:.2g} B in extended, {:.2g} B in quadruple precision. The closed forms "
          "satisfy all constraints from {} on with the paper's constants, from {} on with those proven here",
          in_B(results[0], -63), in_B(results[0], -112), first_that_satisfy("paper_breaks_as_printed"),
          first_that_satisfy("paper_breaks")),
      answered};
}

// --- §5: culling, time ----------------------------------------------------------------------------------------

Measured vertex_edge_culling(const Results& results, const Stop& /*stop*/) {
  struct Interval {
    const char *subject, *about;
  };
  constexpr std::array<Interval, 3> intervals{{{"wang-eps", "with ε^½"},
                                               {"wang-eps:h=0.001", "with the author's 0.001"},
                                               {"wang-scalar", "with an interval for each root"}}};
  const char* const nearly_none = "wang-eps:h=1e-300";
  const auto eliminated = [&](const char* subject, const char* kind) {  // percentage of all tests
    const auto all =
        vertex_edge_tests(results[0], nearly_none, kind) + rejected(results[0], nearly_none, kind, "no-root");
    return 100 *
           (1 - static_cast<double>(vertex_edge_tests(results[0], subject, kind)) / static_cast<double>(all));
  };
  std::vector<std::string> texts;
  for (const auto& [subject, about] : intervals)
    texts.push_back(
        fmt::format("{:.2f} % and {:.2f} % {}", eliminated(subject, "vt"), eliminated(subject, "ee"), about));
  const auto is_enough = [&](const char* subject) {
    return eliminated(subject, "vt") > 99.9 && eliminated(subject, "ee") > 99.9;
  };
  return {fmt::format("of the tests of random pairs, vt and ee: {}", fmt::join(texts, ", ")),
          holds_if(is_enough("wang-eps"))};
}

Measured animation_time(const Results& results, const Stop& /*stop*/) {
  const auto time = [&](const char* subject, const char* kind) {
    return results[0].at("subjects").at(subject).at(kind).at("ns_per_query").get<double>();
  };
  const auto ratio = [&](const char* kind) { return time("wang-scalar", kind) / time("basic", kind); };
  const Ratios scalar{ratio("vt"), ratio("ee")};
  return {fmt::format("wang-scalar takes {} times basic's time in our knot", in_words(scalar)),
          holds_if(scalar.are_at_most(small_overhead))};
}

Measured planeless_time(const Results& results, const Stop& /*stop*/) {
  const Ratios scalar = time_ratios(results[0], "wang-no-planes", "uniform-slow");
  return {fmt::format("slow random pairs: {} times the time of basic-plain", in_words(scalar)),
          holds_if(scalar.are_at_most(small_overhead))};
}

Measured random_time(const Results& results, const Stop& /*stop*/) {
  const Ratios scalar = time_ratios(results[0], "wang-scalar", "uniform");
  return {
      fmt::format("wang-scalar takes {} times basic's time; wang, which decides several queries at once, {}",
                  in_words(scalar), in_words(time_ratios(results[0], "wang", "uniform"))),
      holds_if(scalar.are_at_most(small_overhead))};
}

Measured exact_time(const Results& results, const Stop& /*stop*/) {
  const Ratios parity = time_ratios(results[0], "parity", "uniform");
  const Ratios exact = time_ratios(results[0], "exact", "uniform");
  return {fmt::format("after the box test, exact decisions with a filter, as the paper's exact tests have "
                      "one, take {:.1f} (vt) and {:.1f} (ee) times the time of wang-scalar; root parity in "
                      "rationals, without a filter, "
                      "{:.0f} and {:.0f}. The paper's own figures give 13",
                      exact.vt, exact.ee, parity.vt, parity.ee),
          holds_if(exact.are_at_least(20))};
}

// --- §5 and §6: simulations -----------------------------------------------------------------------------------

Measured more_positives(const Results& results, const Stop& /*stop*/) {
  const Changes changes = changes_with_wang(results, "positives");
  return {changes.text +
              ". Simulations differ after the first false positive, so a number may be negative; with stiff "
              "springs, the differences are larger (fuzz/simulation/README.md)",
          with_condition_if(std::ranges::max(changes.parts) <= 0.1)};
}

Measured case_numbers(const Results& results, const Stop& /*stop*/) {
  const Changes changes = changes_with_wang(results, "queries");
  return {changes.text,
          holds_if(std::ranges::all_of(changes.parts, [](double part) { return std::abs(part) < 0.1; }))};
}

Measured basic_fails(const Results& results, const Stop& /*stop*/) {
  constexpr std::string_view soft = "cloths@64:stiffness=0.01:step=10ms";
  std::uint64_t missed = 0;
  std::uint64_t collisions = 0;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    missed += simulated(results[i], scenes[i], "basic", "false_negatives");
    collisions += simulated(results[i], scenes[i], "basic", "collisions");
  }
  const ordered_json& cloths = results.back();
  const std::uint64_t missed_soft = simulated(cloths, soft, "basic", "false_negatives");
  const auto tangled = [&](const char* subject) {
    return steps(cloths, soft, subject, "tangled").back().get<std::uint64_t>();
  };
  return {
      fmt::format("basic misses {} of {} collisions in our four scenes. In small, soft cloths that a "
                  "search found, it misses {} of {}, and {} pairs stay tangled; {} with wang, {} with exact",
                  missed, with_separators(collisions), missed_soft,
                  with_separators(simulated(cloths, soft, "basic", "collisions")), tangled("basic"),
                  tangled("wang"), tangled("exact")),
      with_condition_if(missed_soft > 0 && tangled("basic") > 0 && tangled("wang") == 0 &&
                        static_cast<double>(missed) < 1e-3 * static_cast<double>(collisions))};
}

Measured hair(const Results& results, const Stop& /*stop*/) {
  const std::uint64_t missed = simulated(results[0], "hair", "basic", "false_negatives");
  return {fmt::format("basic misses {} of {} collisions of our hair", missed,
                      with_separators(simulated(results[0], "hair", "basic", "collisions"))),
          answered};
}

// --- §5 and §6: tolerances and B ------------------------------------------------------------------------------

Measured tolerances_do_not_save(const Results& results, const Stop& /*stop*/) {
  std::vector<std::uint64_t> missed;
  std::vector<std::uint64_t> false_positives;
  std::vector<std::string> list;
  for (const char* value : {"1e-9", "1e-6", "1e-3", "1e-1"}) {
    const std::string subject = fmt::format("bridson:thickness={}", value);
    missed.push_back(count(results[0], subject, "false_negatives"));
    false_positives.push_back(count(results[0], subject, "false_positives"));
    list.push_back(fmt::format("{} and {} with a thickness of {}", with_separators(missed.back()),
                               with_separators(false_positives.back()), value));
  }
  const std::uint64_t by_wang = count(results[0], "wang", "false_negatives");
  return {
      fmt::format(
          "missed of {} collisions in the families planar and sliver, and false positives: {}; {} and {} by "
          "wang",
          with_separators(count(results[0], "wang", "collisions")), fmt::join(list, ", "), by_wang,
          with_separators(count(results[0], "wang", "false_positives"))),
      holds_if(std::ranges::min(missed) > 0 && std::ranges::is_sorted(false_positives) && by_wang == 0)};
}

Measured fewer_positives(const Results& results, const Stop& /*stop*/) {
  const auto of = [&](const char* subject) { return count(results[0], subject, "false_positives"); };
  const auto missed = [&](const char* subject) { return count(results[0], subject, "false_negatives"); };
  std::vector<std::string> list;
  for (const char* subject :
       {"bridson:thickness=1e-9", "bridson:thickness=1e-6", "bridson:thickness=1e-3", "wang"})
    list.push_back(fmt::format("{} by {}", with_separators(of(subject)), subject));
  return {fmt::format(
              "false positives in the families uniform and kilometres, where none of these misses anything "
              "({} in all): {}. In degenerate families, wang has more (user-tolerances)",
              missed("wang") + missed("bridson:thickness=1e-9") + missed("bridson:thickness=1e-6") +
                  missed("bridson:thickness=1e-3"),
              fmt::join(list, ", ")),
          with_condition_if(of("wang") <= of("bridson:thickness=1e-6"))};
}

Measured larger_B(const Results& results, const Stop& /*stop*/) {
  std::vector<std::string> shares;
  std::vector<double> parts;
  for (const std::string subject : {"wang", "wang@4", "wang@16", "wang@64"}) {
    parts.push_back(share(results[0], subject, "false_positives"));
    const auto at = subject.find('@');
    shares.push_back(fmt::format(
        "{:.3f} % {}", 100 * parts.back(),
        at == std::string::npos ? "with the pair's own B" : "with B = " + subject.substr(at + 1)));
  }
  return {fmt::format("false positives among uniform queries: {}", fmt::join(shares, ", ")),
          holds_if(std::ranges::is_sorted(parts) && parts.front() < parts.back())};
}

Measured next_step(const Results& results, const Stop& /*stop*/) {
  const std::uint64_t own = count(results[0], "wang", "false_positives");
  const std::uint64_t larger = count(results[0], "wang@16", "false_positives");
  return {
      fmt::format(
          "{} of {} uniform queries are reported falsely with their own B, {} with B = 16. In our cloths, {} "
          "of {} reports have a time of impact of 0 although the primitives are apart then",
          own, with_separators(count(results[0], "wang", "queries")), larger,
          count(results[1], "wang-time", "stuck"),
          with_separators(count(results[1], "wang-time", "positives"))),
      with_condition_if(larger > own)};
}

// --- §6: exact normals -----------------------------------------------------------------------------------------

Measured exact_normals(const Results& results, const Stop& /*stop*/) {
  const auto sum = [&](const char* subject) { return count(results[0], subject, "false_positives"); };
  const auto mean_ns = [&](const std::string& subject) {
    double ns = 0;
    std::uint64_t queries = 0;
    for (const auto& kind : results[0].at("subjects").at(subject)) {
      const auto asked = kind.at("times").at("timed_queries").get<std::uint64_t>();
      ns += static_cast<double>(asked) * kind.at("times").at("mean_ns").get<double>();
      queries += asked;
    }
    return ns / static_cast<double>(queries);
  };
  const double ratio = mean_ns("wang:dd-normals") / mean_ns("wang-scalar");
  return {fmt::format(
              "normals and weights in double-double: {} false positives in place of {}, in {:.1f} times the "
              "time; {} missed",
              with_separators(sum("wang:dd-normals")), with_separators(sum("wang-scalar")), ratio,
              count(results[0], "wang:dd-normals", "false_negatives")),
          answered};
}

// --- the claims ------------------------------------------------------------------------------------------------

constexpr std::string_view all_families =
    "fuzz --subject wang,wang-eps,wang-plain,wang:float,basic --cases 100000 --no-shrink";

constexpr std::string_view with_tolerances =
    "tightness --family planar,sliver --cases 10000 --subject wang,bridson:thickness=* --values "
    "1e-9,1e-6,1e-3,1e-1";

constexpr std::string_view audit = "audit";
constexpr std::string_view larger_bounds =
    "fuzz --family uniform --subject wang,wang@4,wang@16,wang@64 --cases 100000 --no-shrink";

constexpr std::string_view hair_simulation = "simulate hair --subject exact,wang,basic --no-shrink";
const Commands all_simulations{"simulate knot --subject exact,wang,basic --no-shrink",
                               "simulate cloths --subject exact,wang,basic --no-shrink",
                               "simulate spikes --subject exact,wang,basic --no-shrink", hair_simulation};

/// The commands in `all_simulations`, and one more: the simulation of soft cloths in which basic fails
/// (fuzz/simulation/README.md).
Commands with_soft_cloths() {
  auto commands = all_simulations;
  commands.push_back(
      "simulate cloths@64 --stiffness 0.01 --step-time 10ms --subject exact,wang,basic --no-shrink");
  return commands;
}

const std::array all_claims{
    Claim{"safe", "§1", "unconditionally failure-proof", all_families, safe},
    Claim{"order", "§1", "vertex-edge test with O(ε^⅓) relative error", audit, order},
    Claim{"candidates", "§3.2", "about seven valid candidates on average", {}, candidates},
    Claim{"constants", "§4", "bounds of rounding errors: 22 B²ε, 311 B²ε, 565 B⁴ε and others", audit,
          constants},
    Claim{"bound", "§4.4.1, §4.5.1", "a false positive is at most about 41 B ε^¼ apart",
          "tightness --tolerance proximity,vertex-edge,vertex-vertex --time 8s", bound},
    Claim{"tolerances", "§4.4.1, §5",
          "the proposed tolerances satisfy the constraints of (2) and (3), and are not the tightest", audit,
          closed_forms},
    Claim{"percent",
          "§4.4.1, §4.5.1",
          "in double, 0.5 percent of the maximum edge length",
          {},
          percent_of_edge},
    Claim{"culling", "§5", "culling with ε^½ eliminates more than 99.9 percent of vertex-edge tests",
          "fuzz --family uniform --subject wang-scalar,wang-eps,wang-eps:h=0.001,wang-eps:h=1e-300 --cases "
          "200000 --no-shrink",
          vertex_edge_culling},
    Claim{"larger-B", "§5, §6", "a larger B, as after larger time steps, increases false positives",
          larger_bounds, larger_B},
    Claim{"next-step",
          "§5",
          "collisions may be detected at the starting time of the next step, if B is larger there",
          {larger_bounds, "simulate cloths --subject wang-time --no-shrink"},
          next_step},
    Claim{"animations", "§5", "1.4 percent slower than basic tests in animations (355 ns, 350 ns)",
          "simulate knot --subject basic,wang-scalar --no-shrink", animation_time},
    Claim{"no-planes", "§5", "1.7 percent slower without plane culling (416 ns, 409 ns)",
          "bench --subject basic-plain,wang-no-planes --runs 11", planeless_time},
    Claim{"random-time", "§5", "1.4 percent slower for random pairs in a unit cube (369 ns, 364 ns)",
          "bench --subject basic,wang-scalar,wang --runs 11", random_time},
    Claim{"random-cases", "§5", "10 billion random cases tested",
          "fuzz --family uniform --subject wang,basic --cases 1000000 --no-shrink", random_cases},
    Claim{"exact-time", "§5",
          "20 to 40 times faster than exact tests after culling (4,962 ns after the box test)",
          "bench --subject wang-scalar,exact,parity --queries 2000 --runs 3", exact_time},
    Claim{"boxes", "§5", "nearly half of the random pairs pass the box test", {}, boxes},
    Claim{"planes", "§5", "nearly one third pass plane culling", {}, planes},
    Claim{.name = "peak",
          .section = "§5",
          .says = "up to 20 percent faster than the exact approach at the collision peaking time",
          .why_not = "the paper does not say how its system spends its time at the peak"},
    Claim{"positives", "§5", "up to 10 percent more positives in animations than with exact tests",
          all_simulations, more_positives},
    Claim{"case-numbers", "§5", "total case numbers are about the same as with exact tests", all_simulations,
          case_numbers},
    Claim{.name = "micrometres",
          .section = "§5",
          .says = "a false positive is at most about 20 μm apart in the simulations",
          .why_not =
              "the scenes of the paper are not public; 0.5 percent of an edge is 20 μm for edges of 4 mm"},
    Claim{"basic-fails", "§5", "basic tests fail in one of four animations; failures are extremely rare",
          with_soft_cloths(), basic_fails},
    Claim{"user-tolerances", "§5",
          "no tolerance saves basic tests, and larger ones cause more false positives", with_tolerances,
          tolerances_do_not_save},
    Claim{"fewer-positives", "§5",
          "reduces false positives, in comparison with tolerances that the user chooses",
          "tightness --family uniform,kilometres --cases 20000 --subject wang,bridson:thickness=* --values "
          "1e-9,1e-6,1e-3",
          fewer_positives},
    Claim{"hair", "§5", "asks whether basic tests are more likely to fail in hair animation", hair_simulation,
          hair},
    Claim{"float",
          "§6",
          "in float, as far apart as half of the maximum edge length",
          {audit, "fuzz --search --family uniform --kind ee --subject wang:float --time 40s --no-shrink"},
          half_an_edge},
    Claim{"precisions", "§6", "future work: how errors depend on ε", audit, precisions},
    Claim{"exact-normals", "§6", "asks whether it is worthwhile to compute normals by exact arithmetic",
          "fuzz --subject wang-scalar,wang:dd-normals --kind vt,ee --cases 100000 --no-shrink",
          exact_normals},
    Claim{
        .name = "fast-math",
        .section = "§6",
        .says = "future work: floating-point optimisations",
        .why_not = "tools/environments compiles wang with many compilers and flags (fuzz/studies/README.md)"},
    Claim{.name = "gpu",
          .section = "§6",
          .says = "future work: GPU",
          .why_not = "nearmiss has no CCD for a GPU; a program may be one (pipe:COMMAND)"},
};

}  // namespace

std::string_view name(Judgement judgement) { return names[static_cast<std::size_t>(judgement)]; }

std::optional<Judgement> judgement_named(std::string_view name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Judgement>(found - names.begin());
}

std::span<const Claim> claims() { return all_claims; }

}  // namespace nearmiss::tools::paper
