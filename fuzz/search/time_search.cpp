// Directed search for times of impact that are late, and for the earliest ones.
#include <algorithm>
#include <cmath>

#include "ccd/wang/elementary.hpp"
#include "fuzz/search/search.hpp"
#include "fuzz/search/searched.hpp"
#include "oracle/oracle.hpp"
#include "reports/statistics/family.hpp"

namespace nearmiss {

namespace {

/// A time of impact: that of a subject, and the exact earliest time t*.
struct GivenTime {
  double time;
  EarliestTime& earliest;

  /// time - t*, with the accuracy `rough_time`, or `least` if the difference is small.
  [[nodiscard]] double difference() const {
    Enclosure known = earliest.enclosure(rough_time);
    if (known.lo <= time && time <= known.hi) known = earliest.enclosure(least);
    return time - (known.lo / 2 + known.hi / 2);
  }

  static constexpr double least = 0x1p-50;
};

/// A late time has a higher value than any other time: the later it is, the higher. For all other times, the
/// value is the higher the smaller (t* - time) / t* is.
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
  int slow = 0;        ///< queries over the time limit
  bool found = false;  ///< whether an answer had a time that could be judged

  static constexpr int most_slow = 20;
};

template <double (*objective_of)(const GivenTime&)>
Query search_time(const Searched& subject, Random& random, Kind kind) {
  const double h = subject.separation(random, kind);
  const bool exactly = random.one_in(2) && h == 0;
  const auto placed = [&](const SearchPoint& m) { return exactly ? on_grid(m) : with_gap_within(m, h); };
  Answers answers;
  const auto pass_over = [&] {
    if (++answers.slow == Answers::most_slow && !answers.found) subject.count_slow_search();
    return unwanted;
  };
  const auto objective = [&](const SearchPoint& m) {
    if (answers.slow == Answers::most_slow) return unwanted;
    const Query query = query_of(kind, placed(m), h);
    const auto value = [&](const Verdict& answer) {
      if (answer.fault != Fault::none || !answer.hit || std::isnan(answer.time)) return unwanted;
      auto earliest = earliest_time(subject->rounded(query));
      if (!earliest) return unwanted;
      answers.found = true;
      return objective_of({answer.time, *earliest});
    };
    return subject.objective(query, value, pass_over);
  };
  const auto draw = [&] {
    SearchPoint m = draw_search_point(random, usually_smallest);
    if (h > 0) m.gap = draw_gap(random, h);
    return m;
  };
  return query_of(kind, placed(Maximiser(random, h == 0, usually_smallest, objective).run(draw)), h);
}

}  // namespace

Family late_search(const Subject& subject, const Stop& stop, std::string_view separation) {
  return search_family(late_search_family, "late times, by directed search", search_time<lateness>, subject,
                       stop, separation);
}

Family early_search(const Subject& subject, const Stop& stop, std::string_view separation) {
  return search_family(early_search_family, "early times, by directed search", search_time<earliness>,
                       subject, stop, separation);
}

}  // namespace nearmiss
