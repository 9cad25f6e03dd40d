// The time to the first failure.
#include "fuzz/power/power.hpp"

#include <gtest/gtest.h>

#include "fuzz/subjects.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {
namespace {

std::optional<FirstFailure> first_failure(const std::string& subject, const std::string& family) {
  Subjects subjects;
  subjects.push_back(make_any_subject(subject));
  CampaignPlan plan;
  plan.families = {find_family(family)};
  plan.cases = 20000;
  return find_first_failure(plan, subjects, false);
}

TEST(FirstFailure, IsAMissOrARefutedBound) {
  const auto miss = first_failure("defect:vertex-edge", "planted");
  ASSERT_TRUE(miss);
  EXPECT_EQ(miss->finding.what, Finding::What::false_negative);
  EXPECT_TRUE(collides(miss->finding.query));
  EXPECT_LT(miss->cases, 20000U);  // it stopped there
  EXPECT_GT(miss->cases, 0U);

  const auto refuted = first_failure("defect:lambda2*0", "degenerate");
  ASSERT_TRUE(refuted);
  EXPECT_EQ(refuted->finding.what, Finding::What::refuted_bound);
}

TEST(FirstFailure, IsNothingWhereThereIsNone) { EXPECT_FALSE(first_failure("wang", "planted")); }

}  // namespace
}  // namespace nearmiss
