#include "fuzz/search/search.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <span>

#include "ccd/wang/elementary.hpp"
#include "fuzz/search/maximiser.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"
#include "reports/statistics/family.hpp"
#include "reports/statistics/family_name.hpp"

namespace nearmiss {

namespace {

/// A subject, with the data that its searches share.
class Searched {
 public:
  Searched(const Subject& subject, const Stop& stop, ChooseSeparation separation)
      : subject_(subject), stop_(stop), separation_(std::move(separation)) {}

  [[nodiscard]] const Subject& operator*() const { return subject_; }
  [[nodiscard]] const Subject* operator->() const { return &subject_; }

  /// Draws the separation of one search. If the search is for contact, the separation is 0, and no random
  /// number is drawn.
  [[nodiscard]] double separation(Random& random, Kind kind) const {
    if (!separation_) return 0;
    const SearchPoint typical = draw_search_point(random, usually_smallest);
    return separation_(random, query_of(kind, typical, 0));
  }

  /// The objective of a query: value(answer) for the subject's answer, or if_slow() if the answer exceeds the
  /// time limit. It is `unwanted` if the query is not finite or breaks the subject's contract, or if the
  /// subject is not asked any more. Throws Stopped when the stop is due.
  template <class Value, class IfSlow>
  double objective(const Query& query, const Value& value, const IfSlow& if_slow) const {
    constexpr int most_slow_searches = 3;
    stop_.check();
    if (!is_finite(query) || slow_searches_ >= most_slow_searches) return unwanted;
    const Verdict answer = subject_.decide(query);
    if (answer.fault == Fault::contract) return unwanted;
    return answer.fault == Fault::time ? if_slow() : value(answer);
  }

  /// Counts a search that ended because the subject exceeded its time limit.
  void count_slow_search() const { ++slow_searches_; }

 private:
  const Subject& subject_;
  const Stop& stop_;
  ChooseSeparation separation_;
  mutable std::atomic<int> slow_searches_ = 0;
};

// --- misses and far false positives ---------------------------------------------------------------------

/// How far apart the primitives of a subject's false positive may be: the bound that the subject claims, or
/// wang's bound if the subject claims none.
double reach(const Subject& subject, const Query& query) {
  const double claimed = subject.distance_bound(query);
  return std::isfinite(claimed) && claimed > 0 ? claimed : make_subject("wang")->distance_bound(query);
}

/// The smallest size of primitives in a search. It is smaller than usual if reach() is small. For vv and ve
/// queries, it is always the usual size, because reach() of such queries is a distance minus the separation
/// h, and may be small for every subject.
double smallest_for(const Subject& subject, Random random, Kind kind) {
  if (!is_of_meshes(kind)) return usually_smallest;
  const SearchPoint typical = draw_search_point(random, usually_smallest);
  return std::min(usually_smallest, 1e-3 * reach(subject, query_of(kind, typical, 0)));
}

/// Counts a search in which a query exceeds the time limit. Returns infinity, which ends the search.
double ended_by(const Searched& subject) {
  subject.count_slow_search();
  return HUGE_VAL;
}

/// The weight of each property that makes a collision hard.
struct Mixture {
  std::array<double, 6> of_contact{};
  double of_distance = 0;  ///< if h > 0, the weight of the property that the smallest distance is near h

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

/// A search point near `point` whose primitives meet. If `exactly` is true, the result is on a grid, and its
/// primitives touch exactly. Otherwise, its primitives come within h of each other, up to rounding errors.
SearchPoint meeting(const SearchPoint& point, bool exactly, double h) {
  return exactly ? on_grid(point) : with_gap_within(point, h);
}

SearchPoint draw_meeting(Random& random, double smallest, double h) {
  SearchPoint m = draw_search_point(random, smallest);
  if (h > 0) m.gap = draw_gap(random, h);
  return m;
}

Query search_miss(const Searched& subject, Random& random, Kind kind) {
  const double h = subject.separation(random, kind);
  const Mixture mixture(random, h);
  const bool exactly = random.one_in(2) && h == 0;
  const auto objective = [&](const SearchPoint& anywhere) {
    const SearchPoint m = meeting(anywhere, exactly, h);
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
  const SearchPoint best =
      Maximiser(random, h == 0, smallest, objective).run([&] { return draw_meeting(random, smallest, h); });
  return query_of(kind, meeting(best, exactly, h), h);
}

Query search_far(const Searched& subject, Random& random, Kind kind) {
  const double h = subject.separation(random, kind);
  // The value of a query that collides, from -1 to 0. It grows as the smallest distance approaches h.
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

// --- late times, and the earliest ones ------------------------------------------------------------------

/// The time of impact that a subject gave, and the exact earliest time t*.
struct GivenTime {
  double time;
  EarliestTime& earliest;

  /// The difference time - t*. It is computed from an enclosure of t* with the accuracy `rough_time`. If this
  /// enclosure contains `time`, an enclosure with the accuracy `least` is used instead.
  [[nodiscard]] double difference() const {
    Enclosure known = earliest.enclosure(rough_time);
    if (known.lo <= time && time <= known.hi) known = earliest.enclosure(least);
    return time - (known.lo / 2 + known.hi / 2);
  }

  static constexpr double least = 0x1p-50;
};

/// The value of a time for SearchFor::late. A late time (EarliestTime::makes_late) has a larger value than
/// every other time. Among late times, the value grows with time - t*. Among all other times, the value grows
/// as (t* - time) / t* shrinks.
double lateness(const GivenTime& given) {
  constexpr double late = 200;
  const double least = GivenTime::least;
  const double after = given.difference();
  if (given.earliest.makes_late(given.time)) return late + log2_of(std::max(after, least));
  const double t = std::max(given.time - after, least);
  return -log2_of(std::min(std::max(-after, least) / t, 1.0));
}

double earliness(const GivenTime& given) { return -given.difference(); }

/// The subject's answers in one search.
struct Answers {
  int slow = 0;        ///< the number of queries on which the subject exceeded its time limit
  bool found = false;  ///< whether at least one answer had a time of impact that the search could judge

  static constexpr int most_slow = 20;
};

template <double (*objective_of)(const GivenTime&)>
Query search_time(const Searched& subject, Random& random, Kind kind) {
  const double h = subject.separation(random, kind);
  const bool exactly = random.one_in(2) && h == 0;
  Answers answers;
  const auto pass_over = [&] {
    if (++answers.slow == Answers::most_slow && !answers.found) subject.count_slow_search();
    return unwanted;
  };
  const auto objective = [&](const SearchPoint& m) {
    if (answers.slow == Answers::most_slow) return unwanted;
    const Query query = query_of(kind, meeting(m, exactly, h), h);
    const auto value = [&](const Verdict& answer) {
      if (answer.fault != Fault::none || !answer.hit || std::isnan(answer.time)) return unwanted;
      auto earliest = earliest_time(subject->rounded(query));
      if (!earliest) return unwanted;
      answers.found = true;
      return objective_of({answer.time, *earliest});
    };
    return subject.objective(query, value, pass_over);
  };
  const SearchPoint best = Maximiser(random, h == 0, usually_smallest, objective).run([&] {
    return draw_meeting(random, usually_smallest, h);
  });
  return query_of(kind, meeting(best, exactly, h), h);
}

// --- families -------------------------------------------------------------------------------------------

/// A directed search. `all_searches` is in the order of SearchFor.
struct Search {
  std::string_view prefix;  ///< the start of the family's name
  std::string_view about;
  Query (*one)(const Searched&, Random&, Kind);
};
constexpr std::array<Search, 4> all_searches{
    {{miss_search_family, "collisions that are nearly missed, by directed search", search_miss},
     {far_search_family, "far false positives, by directed search", search_far},
     {late_search_family, "late times, by directed search", search_time<lateness>},
     {early_search_family, "early times, by directed search", search_time<earliness>}}};

}  // namespace

// A query of directed search takes about as long as a few thousand queries of other families, so a block has
// one query. The family is not timed, because its batches are small, and the search warms the caches only for
// its own subject.
Family search_for(SearchFor what, const Subject& subject, const Stop& stop, std::string_view separation) {
  const Search& search = all_searches[static_cast<std::size_t>(what)];
  const std::string name = std::string(search.prefix) + subject.name();
  ChooseSeparation choose;
  if (!separation.empty()) choose = parse_family_separation(separation, name);
  const auto searched = std::make_shared<Searched>(subject, stop, choose);
  return {.name = separation.empty() ? name : name_with_separation(name, separation),
          .about = std::string(search.about),
          .make = [searched, one = search.one](Random& random,
                                               Kind kind) { return one(*searched, random, kind); },
          .block_cases = 1,
          .timed = false,
          .has_separation = !separation.empty()};
}

Family among_vertices(Family search) {
  search.name = std::string(vertices_prefix) + search.name;
  std::ranges::copy(kinds_of_vertices, search.kinds.begin());
  return search;
}

std::vector<Family> searches(const Subject& subject, const Stop& stop, std::string_view separation) {
  const auto all_of = [&](std::string_view h) {
    std::vector<Family> all;
    for (const SearchFor what : {SearchFor::misses, SearchFor::far, SearchFor::late, SearchFor::early})
      if (what < SearchFor::late || subject.time_sort() != TimeSort::none)
        all.push_back(search_for(what, subject, stop, h));
    return all;
  };
  const auto decides_some = [&](std::span<const Kind, 2> some, bool within) {
    return std::ranges::any_of(some, [&](Kind kind) { return subject.is_asked(kind, within); });
  };
  std::vector<Family> all;
  if (decides_some(kinds_of_meshes, !separation.empty())) all = all_of(separation);
  if (decides_some(kinds_of_vertices, true))
    for (Family& each : all_of(separation.empty() ? drawn_separation : separation))
      all.push_back(among_vertices(std::move(each)));
  return all;
}

}  // namespace nearmiss
