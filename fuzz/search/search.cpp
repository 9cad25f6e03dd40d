#include "fuzz/search/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <span>

#include "ccd/wang/elementary.hpp"
#include "fuzz/search/searched.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"
#include "reports/statistics/family.hpp"

namespace nearmiss {

namespace {

/// The largest distance of a subject's false positives: the bound that the subject claims, or wang's if it
/// claims none.
double reach(const Subject& subject, const Query& query) {
  const double claimed = subject.distance_bound(query);
  return std::isfinite(claimed) && claimed > 0 ? claimed : make_subject("wang")->distance_bound(query);
}

/// The smallest size of primitives, which is smaller than usual if the subject has a small reach. That of two
/// vertices, or of a vertex and an edge, is small for other reasons: it is the distance less h.
double smallest_for(const Subject& subject, Random random, Kind kind) {
  if (!is_of_meshes(kind)) return usually_smallest;
  const SearchPoint typical = draw_search_point(random, usually_smallest);
  return std::min(usually_smallest, 1e-3 * reach(subject, query_of(kind, typical, 0)));
}

/// Counts a search that a query over the time limit ends; returns the value that ends it.
double ended_by(const Searched& subject) {
  subject.count_slow_search();
  return HUGE_VAL;
}

/// The weight of each property that makes a collision hard.
struct Mixture {
  std::array<double, 6> of_contact{};
  double of_distance = 0;  ///< for h > 0

  Mixture(Random& random, double h) {
    const auto draw = [&] { return random.one_in(2) ? random.uniform() : 0; };
    for (double& weight : of_contact) weight = draw();
    if (h > 0) of_distance = draw();
  }

  [[nodiscard]] double of(const Query& query, const SearchPoint& point) const {
    double sum = 0;
    const auto hard = hardness(query.kind, point);
    for (std::size_t i = 0; i < hard.size(); ++i) sum -= of_contact[i] * hard[i];
    if (of_distance == 0) return sum;
    constexpr double accuracy = 1e-6;
    const double below = 1 - minimum_distance(query, accuracy).hi / query.separation;
    return sum - of_distance * log2_of(std::max(below, accuracy));
  }
};

Query search_miss(const Searched& subject, Random& random, Kind kind) {
  const double h = subject.separation(random, kind);
  const Mixture mixture(random, h);
  const bool exactly = random.one_in(2) && h == 0;
  const auto placed = [&](const SearchPoint& m) { return exactly ? on_grid(m) : with_gap_within(m, h); };
  const auto objective = [&](const SearchPoint& anywhere) {
    const SearchPoint m = placed(anywhere);
    const Query query = query_of(kind, m, h);
    const auto value = [&](const Verdict& answer) {
      if (!(answer.hit && exactly) && !collides(query)) return unwanted;
      if (!answer.hit) return HUGE_VAL;
      const double needed = subject->needed_tolerance(query);
      return std::isnan(needed) ? mixture.of(query, m) : log2_of(needed);
    };
    return subject.objective(query, value, [&] { return ended_by(subject); });
  };
  const double smallest = exactly ? usually_smallest : smallest_for(*subject, random, kind);
  const auto draw = [&] {
    SearchPoint m = draw_search_point(random, smallest);
    if (h > 0) m.gap = draw_gap(random, h);
    return m;
  };
  return query_of(kind, placed(Maximiser(random, h == 0, smallest, objective).run(draw)), h);
}

Query search_far(const Searched& subject, Random& random, Kind kind) {
  const double h = subject.separation(random, kind);
  // The value of a collision, from -1 to 0. It grows as the smallest distance approaches the separation.
  const auto depth_of = [&](const Query& query) {
    return h == 0 ? 0 : std::min(minimum_distance(query).hi / h - 1, 0.0);
  };
  const auto objective = [&](const SearchPoint& m) {
    const Query query = query_of(kind, m, h);
    const auto value = [&](const Verdict& answer) {
      if (!answer.hit) {
        const double needed = subject->needed_tolerance(query);
        return std::isnan(needed) ? -1 : -log2_of(needed);
      }
      const Decision truth = decide(query);
      if (truth.collision || truth.is_tie) return depth_of(query);
      const double bound = subject->claims_bound() ? subject->distance_bound(query) : reach(*subject, query);
      const double ratio = closest_ratio(query, bound);
      if (!subject->claims_bound()) return ratio;
      return ratio >= 1 && distance_exceeds_separation_by(query, bound) ? HUGE_VAL : std::min(ratio, 1.0);
    };
    return subject.objective(query, value, [&] { return ended_by(subject); });
  };
  const double smallest = smallest_for(*subject, random, kind);
  const auto draw = [&] {
    SearchPoint m = draw_search_point(random, smallest);
    m.gap = random.vector(search_log_uniform(random, 1e-4, 2) * reach(*subject, query_of(kind, m, h)));
    if (h > 0) m.gap += h * m.gap.normalized();
    return m;
  };
  return query_of(kind, Maximiser(random, false, smallest, objective, /*moves_vertices=*/true).run(draw), h);
}

}  // namespace

Family miss_search(const Subject& subject, const Stop& stop, std::string_view separation) {
  return search_family(miss_search_family, "collisions that are nearly missed, by directed search",
                       search_miss, subject, stop, separation);
}

Family far_search(const Subject& subject, const Stop& stop, std::string_view separation) {
  return search_family(far_search_family, "far false positives, by directed search", search_far, subject,
                       stop, separation);
}

Family among_vertices(Family search) {
  search.name = std::string(vertices_prefix) + search.name;
  std::ranges::copy(kinds_of_vertices, search.kinds.begin());
  return search;
}

namespace {

/// All searches of a subject.
std::vector<Family> all_searches(const Subject& subject, const Stop& stop, std::string_view separation) {
  std::vector<Family> all{miss_search(subject, stop, separation), far_search(subject, stop, separation)};
  if (subject.time_sort() != TimeSort::none) {
    all.push_back(late_search(subject, stop, separation));
    all.push_back(early_search(subject, stop, separation));
  }
  return all;
}

}  // namespace

std::vector<Family> searches(const Subject& subject, const Stop& stop, std::string_view separation) {
  const auto decides_some = [&](std::span<const Kind, 2> some, bool within) {
    return std::ranges::any_of(some, [&](Kind kind) { return subject.is_asked(kind, within); });
  };
  std::vector<Family> all;
  if (decides_some(kinds_of_meshes, !separation.empty())) all = all_searches(subject, stop, separation);
  if (decides_some(kinds_of_vertices, true))
    for (Family& each : all_searches(subject, stop, separation.empty() ? drawn_separation : separation))
      all.push_back(among_vertices(std::move(each)));
  return all;
}

}  // namespace nearmiss
