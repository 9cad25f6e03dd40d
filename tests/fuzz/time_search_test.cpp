// Tests the directed search for late and early times of impact, and all searches with a separation.
#include <gmock/gmock.h>

#include <cmath>
#include <memory>

#include "ccd/query/error.hpp"
#include "fuzz/search/search.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"
#include "tests/fuzz/made_up_subjects.hpp"

namespace nearmiss {
namespace {

using testing::MadeUpSubject;

/// A subject that decides a query as the oracle does, but then gives alter(query, verdict) in place of the
/// oracle's verdict.
template <class Answer>
MadeUpSubject altered(const Answer& alter, double bound = HUGE_VAL) {
  const std::shared_ptr<Subject> exact = make_any_subject("exact");
  return {"altered",
          [=](const Query& query) { return alter(query, exact->decide(query)); },
          {.bound = bound,
           .claims_bound = std::isfinite(bound),
           .time_sort = TimeSort::lower_bound,
           .takes_separation = true}};
}

/// The length of the vector (time - 0.4, L - 0.77), where L is the length of the edge x2x3 at t = 0.
double off(const Query& query, double time) {
  return std::hypot(time - 0.4, (query.start(3) - query.start(2)).norm() - 0.77);
}

constexpr double region = 0x1p-10;

/// A subject whose times are late only if off() < region. Then they are late by at most 0.1 * region.
MadeUpSubject late_in_a_region() {
  return altered([](const Query& query, Verdict verdict) {
    if (verdict.hit) verdict.time += 0.1 * (region - off(query, verdict.time)) * std::min(verdict.time, 1.0);
    verdict.time = std::max(verdict.time, 0.0);
    return verdict;
  });
}

/// A subject whose times are up to 1e-3 early. If off() < region, the times are up to 0.2 earlier still.
MadeUpSubject early_in_a_region() {
  return altered([](const Query& query, Verdict verdict) {
    const double inside = std::max(0.0, 1 - off(query, verdict.time) / region);
    verdict.time = std::max(verdict.time - 1e-3 * (1 / (1 + off(query, verdict.time))) - 0.2 * inside, 0.0);
    return verdict;
  });
}

struct ErrorOfTime {
  double after;
  bool is_late;
};

std::optional<ErrorOfTime> error_of(const Subject& subject, const Query& query) {
  const Verdict verdict = subject.decide(query);
  auto earliest = earliest_time(query);
  if (!verdict.hit || !earliest) return std::nullopt;
  return ErrorOfTime{verdict.time - earliest->enclosure().lo, earliest->makes_late(verdict.time)};
}

/// The largest value of sign * (time - t*) among the first queries of a family, where t* is the earliest
/// time, and `sign` is 1 or -1.
double largest(const Subject& subject, const Family& family, std::uint64_t queries, int sign) {
  double found = -1;
  for (std::uint64_t i = 0; i < queries; ++i)
    if (const auto error = error_of(subject, make_query(family, 1, i)))
      found = std::max(found, sign * error->after);
  return found;
}

int late_ones(const Subject& subject, const Family& family, std::uint64_t queries) {
  int late = 0;
  for (std::uint64_t i = 0; i < queries; ++i) {
    const auto error = error_of(subject, make_query(family, 1, i));
    late += error && error->is_late ? 1 : 0;
  }
  return late;
}

TEST(LateSearch, FindsTimesThatAreLateInASmallRegionAlone) {
  const MadeUpSubject subject = late_in_a_region();
  EXPECT_EQ(late_ones(subject, find_family("uniform-end"), 1000), 0);
  EXPECT_GE(late_ones(subject, search_for(SearchFor::late, subject), 10), 3);
}

TEST(LateSearch, GoesOnToTheLatest) {
  const MadeUpSubject subject = late_in_a_region();
  constexpr double latest = 0.1 * region * 0.4;
  const double found = largest(subject, search_for(SearchFor::late, subject), 10, 1);
  EXPECT_GT(found, 0.9 * latest);
  EXPECT_LE(found, 1.1 * latest);
}

TEST(LateSearch, FindsThemForASeparationToo) {
  const MadeUpSubject subject = late_in_a_region();
  for (const char* separation : {"drawn", "0.0625"})
    EXPECT_GE(late_ones(subject, search_for(SearchFor::late, subject, Stop::never(), separation), 4), 1)
        << separation;
}

TEST(LateSearch, FindsNoneIfThereIsNone) {
  const auto exact = make_any_subject("exact");
  for (const char* separation : {"", "drawn"})
    EXPECT_EQ(late_ones(*exact, search_for(SearchFor::late, *exact, Stop::never(), separation), 2), 0)
        << separation;
}

TEST(LateSearch, ShowsCollisionsOfASubjectThatMissesMost) {
  const MadeUpSubject subject = altered([](const Query& query, const Verdict& verdict) {
    return query.x[0] < query.x[3] ? verdict : Verdict{};
  });
  for (std::uint64_t i = 0; i < 6; ++i)
    EXPECT_TRUE(error_of(subject, make_query(search_for(SearchFor::late, subject), 1, i))) << i;
}

TEST(EarlySearch, FindsTheEarliestTimes) {
  const MadeUpSubject subject = early_in_a_region();
  EXPECT_LT(largest(subject, find_family("uniform-end"), 1000, -1), 0.01);
  EXPECT_GT(largest(subject, search_for(SearchFor::early, subject), 5, -1), 0.19);
  EXPECT_GT(largest(subject, search_for(SearchFor::early, subject, Stop::never(), "drawn"), 5, -1), 0.19);
}

TEST(TimeSearches, ArePureFunctionsAndGiveQueriesWithTheirSeparation) {
  const MadeUpSubject subject = late_in_a_region();
  for (const Family& family : searches(subject, Stop::never(), "0.375"))
    EXPECT_TRUE(family.has_separation) << family.name;
  EXPECT_EQ(make_query(searches(subject, Stop::never(), "0.375").front(), 1, 0).separation, 0.375);
  for (const Family& family : searches(subject, Stop::never(), "drawn")) {
    const Query query = make_query(family, 1, 0);
    EXPECT_GT(query.separation, 0) << family.name;
    EXPECT_EQ(make_query(family, 1, 0), query) << family.name;
  }
  const Family contact = searches(subject).front();
  EXPECT_FALSE(contact.has_separation);
  EXPECT_EQ(make_query(contact, 1, 0).separation, 0);
}

TEST(TimeSearches, AreMadeForSubjectsThatGiveTimes) {
  const auto names = [](const Subject& subject, std::string_view separation) {
    std::vector<std::string> found;
    for (const Family& family : searches(subject, Stop::never(), separation)) found.push_back(family.name);
    return found;
  };
  EXPECT_THAT(
      names(*make_any_subject("exact-decision"), ""),
      ::testing::ElementsAre("search-miss-exact-decision", "search-far-exact-decision",
                             "v-search-miss-exact-decision~drawn", "v-search-far-exact-decision~drawn"));
  EXPECT_THAT(names(*make_any_subject("wang-time"), ""),
              ::testing::ElementsAre("search-miss-wang-time", "search-far-wang-time", "search-late-wang-time",
                                     "search-early-wang-time", "v-search-miss-wang-time~drawn",
                                     "v-search-far-wang-time~drawn", "v-search-late-wang-time~drawn",
                                     "v-search-early-wang-time~drawn"));
  EXPECT_THAT(names(*make_any_subject("wang"), "drawn"),
              ::testing::ElementsAre("v-search-miss-wang~drawn", "v-search-far-wang~drawn"));
  EXPECT_THAT(names(*make_any_subject("advance"), "drawn"),
              ::testing::ElementsAre("search-miss-advance~drawn", "search-far-advance~drawn",
                                     "search-late-advance~drawn", "search-early-advance~drawn",
                                     "v-search-miss-advance~drawn", "v-search-far-advance~drawn",
                                     "v-search-late-advance~drawn", "v-search-early-advance~drawn"));
  for (const char* none : {"0", "near"})
    EXPECT_THROW(names(*make_any_subject("exact"), none), nearmiss::Error) << none;
}

/// The subject misses collisions whose smallest distance is at least 0.999 times the separation.
TEST(MissSearch, FindsMissesNextToTheSeparation) {
  const MadeUpSubject subject = altered([](const Query& query, const Verdict& verdict) {
    const bool near = query.separation > 0 && distance_exceeds(query, 0.999 * query.separation);
    return near ? Verdict{} : verdict;
  });
  int missed = 0;
  for (std::uint64_t i = 0; i < 10; ++i) {
    const Query query = make_query(search_for(SearchFor::misses, subject, Stop::never(), "drawn"), 1, i);
    missed += collides(query) && !subject.decide(query).hit ? 1 : 0;
  }
  EXPECT_GE(missed, 5);
}

/// The subject reports pairs that come within the separation plus 1e-3, but claims only half of this margin
/// as its bound.
TEST(FarSearch, RefutesBoundsBeyondTheSeparation) {
  const MadeUpSubject subject = altered(
      [](const Query& query, Verdict verdict) {
        verdict.hit = !distance_exceeds(query, query.separation + 1e-3);
        return verdict;
      },
      0.5e-3);
  int refuted = 0;
  for (std::uint64_t i = 0; i < 10; ++i) {
    const Query query = make_query(search_for(SearchFor::far, subject, Stop::never(), "drawn"), 1, i);
    refuted += subject.decide(query).hit && distance_exceeds(query, query.separation + 0.5e-3) ? 1 : 0;
  }
  EXPECT_GE(refuted, 5);
}

}  // namespace
}  // namespace nearmiss
