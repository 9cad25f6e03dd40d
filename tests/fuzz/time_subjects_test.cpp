// Tests the subjects of ccd/ that give times, on all families.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>

#include "oracle/earliest_time.hpp"
#include "oracle/oracle.hpp"
#include "tests/fuzz/family_queries.hpp"
#include "tests/fuzz/trials.hpp"

namespace nearmiss {
namespace {

/// The counters of each kind, after a trial with `count` queries that a family makes from seed 3.
std::vector<Counts> counts_of(const std::string& subject, const Family& family, std::uint64_t count) {
  const Subjects subjects = testing::one(make_any_subject(subject));
  std::vector<Counts> found;
  for (const Kind kind : kinds) {
    if (!has_kind(family, kind)) continue;
    std::vector<Query> queries;
    std::vector<std::uint64_t> indices;
    for (std::uint64_t i = 0; queries.size() < count; ++i) {
      if (kind_of(family, i) != kind) continue;
      queries.push_back(make_query(family, 3, i));
      indices.push_back(i);
    }
    Batch batch = testing::batch_of(family.name, queries);
    batch.timed = false;
    batch.provenance = [&](std::size_t i) { return family.name + ":3:" + std::to_string(indices[i]); };
    const TrialResult result = hold_trial(subjects, batch);
    for (const Finding& finding : result.findings)
      if (finding.what != Finding::What::committed)  // a finding about a committed step is no failure
        ADD_FAILURE() << subject << ": " << name(finding.what) << ", " << finding.provenance;
    found.push_back(result.statistics.counts.at({subject, kind, family.name}));
  }
  return found;
}

/// The number of queries to ask of each kind: `usual`, or fewer if the family is slow.
std::uint64_t cases(const Family& family, std::uint64_t usual) {
  return family.block_cases < 25 ? usual / 10 : usual;
}

class TimesOf : public ::testing::TestWithParam<Family> {};
INSTANTIATE_TEST_SUITE_P(AllFamilies, TimesOf,
                         ::testing::ValuesIn(mesh_families().begin(), mesh_families().end()),
                         testing::name_of_test);

class TimesOfContact : public TimesOf {};
INSTANTIATE_TEST_SUITE_P(FamiliesOfContact, TimesOfContact,
                         ::testing::ValuesIn(families().begin(), families().end()), testing::name_of_test);

TEST_P(TimesOfContact, WangTimeMissesNothingAndIsNeverLate) {
  for (const Counts& counts : counts_of("wang-time", GetParam(), cases(GetParam(), 1000)))
    EXPECT_EQ(counts.times_given, counts.collisions);
}

class TimesOfVertices : public TimesOf {};
INSTANTIATE_TEST_SUITE_P(FamiliesOfVertices, TimesOfVertices,
                         ::testing::ValuesIn(vertex_families().begin(), vertex_families().end()),
                         testing::name_of_test);

TEST_P(TimesOfVertices, AreNeverLateAndTheSubjectsMissNothing) {
  for (const char* subject : {"wang-time", "advance"})
    for (const Counts& counts : counts_of(subject, as_asked(GetParam()), 400)) {
      EXPECT_EQ(counts.times_given, counts.collisions) << subject;
      EXPECT_EQ(counts.refuted_bounds, 0) << subject;
    }
}

/// Expects that wang-time decides the first queries of a family as wang does. Skips queries of the kinds vv
/// and ve, and queries with separations.
void expect_same_decisions(const Subject& wang, const Family& family, std::uint64_t count) {
  const auto timed = make_any_subject("wang-time");
  for (std::uint64_t i = 0; i < count; ++i) {
    Query query = make_query(family, 3, i);
    if (is_of_meshes(query.kind)) query.separation = 0;
    const Verdict expected = wang.decide(query);
    const Verdict verdict = timed->decide(query);
    ASSERT_EQ(verdict.hit, expected.hit) << i;
    ASSERT_EQ(verdict.stage, expected.stage) << i;
    ASSERT_EQ(verdict.rejection, expected.rejection) << i;
    ASSERT_EQ(timed->distance_bound(query), wang.distance_bound(query)) << i;
  }
}

TEST_P(TimesOfVertices, WangTimeDecidesAsWang) {
  expect_same_decisions(*make_any_subject("wang-scalar"), as_asked(GetParam()), 400);
}

TEST_P(TimesOf, WangTimeDecidesAsWang) {
  expect_same_decisions(*make_any_subject("wang"), GetParam(), cases(GetParam(), 1000));
}

TEST_P(TimesOf, AdvanceMissesNothingAndIsNeverLateOrBeyondItsBound) {
  for (const Counts& counts : counts_of("advance", GetParam(), cases(GetParam(), 1000)))
    EXPECT_EQ(counts.times_given, counts.collisions);
}

TEST_P(TimesOfContact, AdvanceIsSoundWithSeparations) {
  const Family family = with_separation(GetParam(), drawn_separation);
  for (const Counts& counts : counts_of("advance", family, cases(GetParam(), 400)))
    EXPECT_EQ(counts.times_given, counts.collisions);
}

TEST(TimesOfSubjects, AreNearWhereNothingIsHard) {
  const std::map<std::pair<std::string, std::string>, double> largest{
      {{"wang-time", "uniform"}, 1e-8},
      {{"advance", "uniform"}, 1e-9},
      {{"wang-time", "v-uniform~drawn"}, 1e-9},
      {{"advance", "v-uniform~drawn"}, 1e-9}};
  for (const auto& [of, error] : largest)
    for (const Counts& counts : counts_of(of.first, find_family(of.second), 2000)) {
      const std::string subject = of.first + ' ' + of.second;
      EXPECT_GT(counts.collisions, 100) << subject;
      EXPECT_LT(counts.early_quantile(0.99).to, error) << subject;
      EXPECT_EQ(counts.stuck, 0) << subject;
    }
}

TEST(TimesOfSubjects, AreOfTheSortThatEachPromises) {
  const std::map<TimeSort, std::vector<const char*>> subjects{
      {TimeSort::estimate, {"basic", "basic-plain", "bridson", "basic:float"}},
      {TimeSort::none,
       {"wang", "wang-eps", "wang-plain", "wang-scalar", "wang-tight", "wang:dd", "adaptive", "parity"}},
      {TimeSort::lower_bound, {"wang-time", "advance"}}};
  for (const auto& [sort, names] : subjects)
    for (const char* name : names) EXPECT_EQ(make_any_subject(name)->time_sort(), sort) << name;
}

TEST(TimesOfSubjects, OnlyAdvanceAndTheExactOnesTakeASeparation) {
  for (const char* name : {"basic", "wang", "wang-time", "wang:dd", "adaptive"})
    for (const Kind kind : kinds_of_meshes)
      EXPECT_FALSE(make_any_subject(name)->takes_separation(kind)) << name;
  for (const char* name : {"advance", "exact"})
    for (const Kind kind : kinds_of_meshes)
      EXPECT_TRUE(make_any_subject(name)->takes_separation(kind)) << name;
  for (const char* name : {"wang", "wang-tight", "wang-time", "advance", "exact"})
    for (const Kind kind : {Kind::vertex_vertex, Kind::vertex_edge}) {
      EXPECT_TRUE(make_any_subject(name)->decides(kind)) << name;
      EXPECT_TRUE(make_any_subject(name)->takes_separation(kind)) << name;
    }
}

// The time that basic gives is the root of F, the coplanarity cubic, at which basic accepts the pair.
TEST(TimesOfSubjects, BasicGivesTheTimeOfContact) {
  const auto basic = make_any_subject("basic");
  int hits = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Query query = make_query(find_family("uniform"), 3, i);
    const Verdict verdict = basic->decide(query);
    if (!verdict.hit) continue;
    ++hits;
    EXPECT_NEAR(verdict.time, earliest_time(query)->known().lo, 1e-12) << i;
  }
  EXPECT_GT(hits, 100);
}

}  // namespace
}  // namespace nearmiss
