#include "fuzz/studies/tightness.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "fuzz/parallel.hpp"
#include "fuzz/search/search.hpp"
#include "fuzz/subjects/defects.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

namespace {

using std::chrono::steady_clock;

/// A group of tests with which wang accepts queries. `subject` names the CCD on which the group is measured.
/// This CCD is wang without the other groups of tests that accept pairs at larger distances.
struct Tests {
  std::string_view name, subject;
};
constexpr std::array tests_table{
    Tests{"proximity", "defect:vertex-edge"},
    Tests{"vertex-edge", "defect:vv"},
    Tests{"vertex-vertex", "wang"},
};

/// How to measure the slack of one tolerance, or of one group of tests.
struct Gauge {
  Extreme nothing;
  std::unique_ptr<Subject> subject;
  Family search;
  /// Measures a query. Returns `nothing.value` if the query shows nothing, and std::nullopt if it is no
  /// collision (for a tolerance) or no false positive (for a group of tests).
  std::function<std::optional<double>(const Query&)> read;
};

/// The family of a directed search. If `among` is set, the family has vv and ve queries.
Family search_by(SearchFor what, const Subject& subject, bool among, const Stop& stop) {
  return among ? among_vertices(search_for(what, subject, stop, drawn_separation))
               : search_for(what, subject, stop);
}

Gauge tolerance_gauge(const NamedTolerance& tolerance, bool among, const Stop& stop) {
  auto subject = try_make_defect(scaled_tolerance(tolerance.name, 1));
  auto search = search_by(SearchFor::misses, *subject, among, stop);
  const auto of = tolerance.accepts ? Extreme::Of::accepting_tolerance : Extreme::Of::keeping_tolerance;
  auto nothing = nothing_found(of, std::string(tolerance.name));
  const auto read = [&tolerance, &subject = *subject,
                     none = nothing.value](const Query& query) -> std::optional<double> {
    if (!collides(query)) return std::nullopt;
    // needed_tolerance() overestimates slightly. The query counts only if the subject indeed misses the
    // collision with a slightly smaller factor.
    constexpr double less = 0.98;
    const double needed = subject.needed_tolerance(query) * less;
    const double factor = tolerance.accepts ? needed : 1 / needed;
    return try_make_defect(scaled_tolerance(tolerance.name, factor))->decide(query).hit ? none : factor;
  };
  return {std::move(nothing), std::move(subject), std::move(search), read};
}

Gauge tests_gauge(const Tests& tests, bool among, const Stop& stop) {
  auto subject = make_any_subject(tests.subject);
  auto search = search_by(SearchFor::far, *subject, among, stop);
  const auto read = [&subject = *subject](const Query& query) -> std::optional<double> {
    if (!subject.decide(query).hit || collides(query)) return std::nullopt;
    return closest_ratio(query, subject.distance_bound(query));
  };
  return {nothing_found(Extreme::Of::distance, std::string(tests.name)), std::move(subject),
          std::move(search), read};
}

/// Whether only queries with four vertices use this tolerance or group of tests. In that case, Algorithms 1
/// and 2, which decide the queries with fewer vertices, do not use the tolerance or the group.
bool needs_four_vertices(std::string_view name) {
  constexpr std::array<std::string_view, 4> all{"eta", "mu", "tau", "proximity"};
  return std::ranges::find(all, name) != all.end();
}

Gauge gauge_of(std::string_view name, bool among, const Stop& stop) {
  const auto is_it = [&](const auto& each) {
    return each.name == name && !(among && needs_four_vertices(name));
  };
  for (const NamedTolerance& tolerance : named_tolerances())
    if (is_it(tolerance)) return tolerance_gauge(tolerance, among, stop);
  for (const Tests& tests : tests_table)
    if (is_it(tests)) return tests_gauge(tests, among, stop);
  throw Error(fmt::format("unknown tolerance '{}', expected some of {}", excerpt(name),
                          fmt::join(tightness_names(among), ", ")));
}

/// The most extreme value that the gauge reads in `count` queries of a family, from query number `first` on.
Extreme read_block(const Gauge& gauge, const Family& family, std::uint64_t seed, std::uint64_t first,
                   std::uint64_t count, const Stop& stop) {
  Extreme sum = gauge.nothing;
  for (std::uint64_t index = first; index < first + count; ++index) {
    stop.check();
    Extreme one = gauge.nothing;
    one.query = make_query(family, seed, index);
    if (const auto value = gauge.read(one.query)) {
      one.value = *value;
      one.queries = 1;
      if (*value != gauge.nothing.value) one.provenance = fmt::format("{}:{}:{}", family.name, seed, index);
      sum.merge(one);
    }
  }
  return sum;
}

}  // namespace

std::vector<std::string> tightness_names(bool among_vertices) {
  std::vector<std::string> names;
  for (const NamedTolerance& tolerance : named_tolerances()) names.emplace_back(tolerance.name);
  for (const Tests& tests : tests_table) names.emplace_back(tests.name);
  if (among_vertices) std::erase_if(names, needs_four_vertices);
  return names;
}

void measure_tightness(const TightnessPlan& plan, const TightnessSink& sink, const std::atomic<bool>& stop) {
  const Stop ending(stop);
  std::vector<Gauge> gauges;
  for (const std::string& name : plan.names) gauges.push_back(gauge_of(name, plan.among_vertices, ending));
  for (const Gauge& gauge : gauges) {
    if (stop) return;
    Extreme sum = gauge.nothing;
    const auto start = steady_clock::now();
    const std::size_t wave = 8 * static_cast<std::size_t>(plan.jobs);
    for (std::uint64_t round = 0; !stop && steady_clock::now() - start < plan.time; ++round) {
      std::vector<Extreme> parts(wave, gauge.nothing);
      try {
        in_parallel(plan.jobs, wave, [&](std::size_t i) {
          const std::uint64_t number = round * (wave / 2) + i / 2;  // counts the blocks of each source
          const std::uint64_t families = plan.families.size();
          parts[i] = i % 2 == 0 ? read_block(gauge, gauge.search, plan.seed, 4 * number, 4, ending)
                                : read_block(gauge, plan.families[number % families], plan.seed,
                                             1000 * (number / families), 1000, ending);
        });
      } catch (const Stopped&) {  // completed parts count
      }
      for (const Extreme& part : parts) sum.merge(part);
      sink(sum, false);
    }
    sink(sum, true);
  }
}

}  // namespace nearmiss
