#include "fuzz/studies/tightness.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

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

/// A group of the tests with which wang accepts a query. The subject is wang without the tests that accept
/// from farther away than this group.
struct Tests {
  std::string_view name, subject;
};
constexpr std::array tests_table{
    Tests{"proximity", "defect:vertex-edge"},
    Tests{"vertex-edge", "defect:vv"},
    Tests{"vertex-vertex", "wang"},
};

/// How to measure one tolerance or group of tests.
struct Gauge {
  Extreme nothing;
  std::unique_ptr<Subject> subject;
  Family search;
  /// Measures a query. The result is `nothing.value` if the query shows nothing, and std::nullopt if it is
  /// not of the kind that is measured (collisions, or false positives).
  std::function<std::optional<double>(const Query&)> read;
};

/// A search as miss_search() or far_search(), among pairs of meshes or among vertices.
template <class Search>
Family search_by(const Search& search, const Subject& subject, bool among) {
  return among ? among_vertices(search(subject, Stop::never(), drawn_separation))
               : search(subject, Stop::never(), "");
}

Gauge tolerance_gauge(const NamedTolerance& tolerance, bool among) {
  auto subject = try_make_defect(scaled_tolerance(tolerance.name, 1));
  auto search = search_by(miss_search, *subject, among);
  const auto of = tolerance.accepts ? Extreme::Of::accepting_tolerance : Extreme::Of::keeping_tolerance;
  auto nothing = nothing_found(of, std::string(tolerance.name));
  const auto read = [&tolerance, &subject = *subject,
                     none = nothing.value](const Query& query) -> std::optional<double> {
    if (!collides(query)) return std::nullopt;
    // needed_tolerance is a slight overestimate. The query gives a value only if the subject indeed misses it
    // with a slightly smaller factor.
    constexpr double less = 0.98;
    const double needed = subject.needed_tolerance(query) * less;
    const double factor = tolerance.accepts ? needed : 1 / needed;
    return try_make_defect(scaled_tolerance(tolerance.name, factor))->decide(query).hit ? none : factor;
  };
  return {std::move(nothing), std::move(subject), std::move(search), read};
}

Gauge tests_gauge(const Tests& tests, bool among) {
  auto subject = make_any_subject(tests.subject);
  auto search = search_by(far_search, *subject, among);
  const auto read = [&subject = *subject](const Query& query) -> std::optional<double> {
    if (!subject.decide(query).hit || collides(query)) return std::nullopt;
    return closest_ratio(query, subject.distance_bound(query));
  };
  return {nothing_found(Extreme::Of::distance, std::string(tests.name)), std::move(subject),
          std::move(search), read};
}

Gauge gauge_of(std::string_view name, bool among) {
  for (const NamedTolerance& tolerance : named_tolerances())
    if (tolerance.name == name) return tolerance_gauge(tolerance, among);
  for (const Tests& tests : tests_table)
    if (tests.name == name) return tests_gauge(tests, among);
  throw Error(fmt::format("unknown tolerance '{}', expected some of {}", excerpt(name),
                          fmt::join(tightness_names(), ", ")));
}

/// The extreme value among a block of queries of a family.
Extreme read_block(const Gauge& gauge, const Family& family, std::uint64_t seed, std::uint64_t first,
                   std::uint64_t count) {
  Extreme sum = gauge.nothing;
  for (std::uint64_t index = first; index < first + count; ++index) {
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

std::vector<std::string> tightness_names() {
  std::vector<std::string> names;
  for (const NamedTolerance& tolerance : named_tolerances()) names.emplace_back(tolerance.name);
  for (const Tests& tests : tests_table) names.emplace_back(tests.name);
  return names;
}

void measure_tightness(const TightnessPlan& plan, const TightnessSink& sink, const std::atomic<bool>& stop) {
  std::vector<Gauge> gauges;
  for (const std::string& name : plan.names) gauges.push_back(gauge_of(name, plan.among_vertices));
  for (const Gauge& gauge : gauges) {
    if (stop) return;
    Extreme sum = gauge.nothing;
    const auto start = steady_clock::now();
    const std::size_t wave = 8 * static_cast<std::size_t>(plan.jobs);
    for (std::uint64_t round = 0; !stop && steady_clock::now() - start < plan.time; ++round) {
      std::vector<Extreme> parts(wave, gauge.nothing);
      in_parallel(plan.jobs, wave, [&](std::size_t i) {
        const std::uint64_t number = round * (wave / 2) + i / 2;  // index among the blocks of its sort
        const std::uint64_t families = plan.families.size();
        parts[i] = i % 2 == 0 ? read_block(gauge, gauge.search, plan.seed, 4 * number, 4)
                              : read_block(gauge, plan.families[number % families], plan.seed,
                                           1000 * (number / families), 1000);
      });
      for (const Extreme& part : parts) sum.merge(part);
      sink(sum, false);
    }
    sink(sum, true);
  }
}

}  // namespace nearmiss
