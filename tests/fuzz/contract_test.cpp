// Tests which queries a trial asks a subject with a contract, and which queries it leaves out.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "fuzz/subjects/contracted.hpp"
#include "fuzz/trial/shrunk_finding.hpp"
#include "tests/fuzz/made_up_subjects.hpp"
#include "tests/fuzz/trials.hpp"
#include "tests/plugins.hpp"

namespace nearmiss {
namespace {

using testing::falling_vertex;

/// A subject with this contract. The subject misses every collision, and adds each query that it is asked to
/// `asked`.
std::unique_ptr<Subject> noting(const Contract& contract, std::vector<Query>& asked) {
  const auto note = [&](const Query& query) {
    asked.push_back(query);
    return Verdict{};
  };
  return std::make_unique<testing::MadeUpSubject>("noting", note, testing::Claims{.contract = contract});
}

constexpr Contract apart{.apart_at_start = true};

/// A batch of collisions. In every third query, the primitives already touch at t = 0.
Batch batch() {
  std::vector<Query> queries;
  for (int i = 0; i < 30; ++i) queries.push_back(falling_vertex(0.25, 0.25, i % 3, -1));
  return testing::batch_of("falling", queries);
}

TEST(ContractedSubject, IsNotAskedQueriesBeyondItsContractButApart) {
  std::vector<Query> asked, others;
  hold_trial(keep_contract(noting(apart, asked), false), batch());
  for (const Query& query : asked) EXPECT_TRUE(keeps_contract(query, apart));
  const Subjects subjects = keep_contract(noting(apart, others), true);
  ASSERT_EQ(subjects.size(), 2U);
  const TrialResult result = hold_trial(subjects, batch());
  const auto counts_of = [&](const std::string& subject) {
    return result.statistics.counts.at({subject, Kind::vertex_triangle, "falling"});
  };
  const Counts within = counts_of("noting"), beyond = counts_of("noting (beyond contract)");
  EXPECT_EQ(within.queries, 30);
  EXPECT_EQ(within.without_answer(Fault::contract), 10);
  EXPECT_EQ(within.collisions, 20);
  EXPECT_EQ(within.false_negatives, 20);
  EXPECT_EQ(beyond.collisions, 10);
  EXPECT_EQ(beyond.false_negatives, 10);
  EXPECT_EQ(result.findings.size(), 30U);
  EXPECT_EQ(keep_contract(noting(apart, asked), false).size(), 1U);
  EXPECT_EQ(keep_contract(noting({}, asked), true).size(), 1U);
}

TEST(ContractedSubject, ShrinkingStaysOnTheSameSideOfTheContract) {
  std::vector<Query> asked;
  const Subjects sides = keep_contract(noting(apart, asked), true);
  for (const bool keeps : {true, false}) {
    const Subject& subject = *sides[keeps ? 0 : 1];
    const Query query = falling_vertex(0.3, 0.21, keeps ? 0.7 : 0, -0.4);
    const TrialResult result = hold_trial(sides, testing::batch_of("one", {query}));
    ASSERT_EQ(result.findings.size(), 1U);
    const Query shrunk = shrunk_query(result.findings.front(), &subject, Stop::never());
    EXPECT_NE(shrunk, query);
    EXPECT_EQ(keeps_contract(shrunk, apart), keeps);
  }
}

TEST(ContractedSubject, ItsContractIsAboutTheRoundedQuery) {
  const Subjects sides = keep_contract(make_any_subject(testing::plugin("several") + ":narrow-apart"), true);
  ASSERT_EQ(sides.size(), 2U);
  const Query query = falling_vertex(0.25, 0.25, 1e-60, -1);  // the height is rounded to 0 in float
  EXPECT_EQ(sides[0]->decide(query).fault, Fault::contract);
  EXPECT_EQ(sides[1]->decide(query).fault, Fault::none);
  for (const auto& side : sides)
    EXPECT_EQ(plugin_info(*side)->name, "narrow-apart") << "it is still a plug-in";
}

TEST(ContractedSubject, ContractsInWords) {
  EXPECT_EQ(in_words({}), "");
  EXPECT_EQ(in_words({.apart_at_start = true, .grid = 0.25}),
            "the primitives are apart at t = 0; coordinates are multiples of 0.25");
  EXPECT_EQ(
      in_words({.apart_at_start = true, .one_root = true, .apart_by = 1e-8}),
      "the distance at t = 0 is more than 1e-08; the vertices' volume has one root at most, a simple one");
}

}  // namespace
}  // namespace nearmiss
