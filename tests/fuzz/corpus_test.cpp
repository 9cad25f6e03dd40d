// Tests the corpus. Every case has a reason, and records a truth with which the oracle agrees. wang reports
// every collision of the corpus.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>

#include "ccd/subjects/subject.hpp"
#include "corpus/readers.hpp"
#include "fuzz/subjects/defects.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {
namespace {

std::vector<Case> corpus() {
  std::vector<Case> cases;
  read_cases(NEARMISS_CORPUS, [&](Case&& each) { cases.push_back(std::move(each)); });
  return cases;
}

TEST(Corpus, EveryCaseSaysWhyItIsThere) {
  const auto cases = corpus();
  EXPECT_GE(cases.size(), 40);
  for (const Case& each : cases) {
    EXPECT_FALSE(each.why.empty()) << each.name;
    EXPECT_TRUE(each.truth) << each.name;
    EXPECT_FALSE(each.provenance.empty()) << each.name;
  }
}

TEST(Corpus, TheOracleAgreesWithEveryRecordedTruth) {
  for (const Case& each : corpus()) {
    const Decision decision = decide(each.query);
    EXPECT_EQ(decision.collision || decision.is_tie, each.truth) << each.name;
  }
}

// Queries of public test suites, with the expected answers. One expectation is wrong; the case
// contact/ee-unstated-separation explains it.
TEST(Corpus, PublicSuitesExpectWhatTheOracleSaysExceptOnce) {
  const std::filesystem::path suites = NEARMISS_CORPUS "/../../../shared/suites";
  if (!std::filesystem::exists(suites)) GTEST_SKIP() << "found no folder ../shared/suites";
  std::vector<Query> wrong;
  int expected = 0;
  read_cases(suites, [&](Case&& each) {
    if (!each.truth) return;
    ++expected;
    if (decide(each.query).collision != *each.truth) wrong.push_back(each.query);
  });
  EXPECT_GT(expected, 500);
  ASSERT_EQ(wrong.size(), 1);
  read_cases(NEARMISS_CORPUS "/contact/ee-unstated-separation.case", [&](Case&& each) {
    EXPECT_EQ(wrong.front(), each.query);
    EXPECT_EQ(each.truth, false);
  });
}

TEST(Corpus, EveryWangReportsEveryCollision) {
  for (const char* name :
       {"wang", "wang-eps", "wang-eps:h=0.001", "wang-plain", "wang-tight", "wang:dd-normals"}) {
    const auto subject = make_any_subject(name);
    for (const Case& each : corpus()) {
      if (each.query.separation > 0 && !subject->takes_separation(each.query.kind)) continue;
      EXPECT_GE(subject->decide(each.query).hit, *each.truth) << name << ", " << each.name;
    }
  }
}

// `nearmiss power` measures how soon a campaign finds a defect, so the subject with a defect must miss a
// collision, whatever the defect is.
TEST(Corpus, EachDefectMissesItsOwnCase) {
  std::set<std::string> missed;
  read_cases(NEARMISS_CORPUS "/defects", [&](const Case& each) {
    const std::string start = "Missed by ";
    ASSERT_TRUE(each.why.starts_with(start)) << each.name;
    const std::string name = each.why.substr(start.size(), each.why.find(' ', start.size()) - start.size());
    const auto defect = try_make_defect(name);
    ASSERT_TRUE(defect) << each.name;
    EXPECT_FALSE(defect->decide(each.query).hit) << each.name;
    missed.insert(name);
  });
  EXPECT_GE(missed.size(), 35U);
}

// The paper's Algorithm 2 tries several cases in turn. For each of them, the corpus has a query that no
// earlier case reports.
TEST(Corpus, EachVertexEdgeCaseAcceptsItsOwn) {
  const std::map<std::string, Stage> stages{
      {"case-1-end.case", Stage::ve_end},     {"case-2-minimum.case", Stage::ve_minimum},
      {"case-3-equal.case", Stage::ve_equal}, {"case-4-zero.case", Stage::ve_zero},
      {"case-5-vertex.case", Stage::vv},      {"case-5-vertex-hit.case", Stage::vv},
  };
  const auto subject = make_subject("wang");
  std::size_t seen = 0;
  read_cases(NEARMISS_CORPUS "/kkt", [&](const Case& each) {
    const auto name = std::filesystem::path(each.name).filename().string();
    EXPECT_EQ(subject->decide(each.query).stage, stages.at(name)) << each.name;
    ++seen;
  });
  EXPECT_EQ(seen, stages.size());
}

}  // namespace
}  // namespace nearmiss
