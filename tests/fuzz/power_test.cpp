// Tests how the first failure of a campaign, and the time to this failure, are found.
#include "fuzz/studies/power.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "oracle/oracle.hpp"
#include "tests/fuzz/trials.hpp"

namespace nearmiss {
namespace {

std::optional<FirstFailure> first_failure(const std::string& subject, const std::string& family) {
  CampaignPlan plan;
  plan.families = {find_family(family)};
  plan.cases = 10000;
  return find_first_failure(plan, testing::one(make_any_subject(subject)), Stop::never());
}

TEST(FirstFailure, IsAMissARefutedBoundOrALateTime) {
  using What = Finding::What;
  const std::tuple<const char*, const char*, What> expected[]{
      {"defect:vertex-edge", "planted", What::false_negative},
      {"defect:lambda2*0", "degenerate", What::refuted_bound},
      {"defect:upper-end", "uniform", What::late}};
  for (const auto& [subject, family, what] : expected) {
    const auto failure = first_failure(subject, family);
    ASSERT_TRUE(failure) << subject;
    EXPECT_EQ(failure->finding.what, what) << subject;
  }
  EXPECT_FALSE(first_failure("wang", "planted"));
  EXPECT_FALSE(first_failure("advance", "uniform~drawn"));
}

std::uint64_t cases_one_by_one(const Subject& subject, const Family& family) {
  for (std::uint64_t index = 0;; ++index) {
    const Query query = make_query(family, 1, index);
    if (collides(query) && !subject.decide(query).hit) return index + 1;
  }
}

TEST(FirstFailure, IsCountedUpToTheCaseItself) {
  for (const char* name : {"defect:vertex-edge", "basic"}) {
    const auto subject = make_any_subject(name);
    EXPECT_EQ(first_failure(name, "planted")->cases, cases_one_by_one(*subject, find_family("planted")));
  }
}

TEST(FamiliesFor, HaveSeparationsTooForASubjectThatTakesThem) {
  const auto names = [](const char* subject) {
    std::vector<std::string> found;
    const std::array of_contact{find_family("uniform"), find_family("planted")};
    for (const Family& family :
         families_for(*make_any_subject(subject), of_contact, std::array{find_family("v-uniform")}))
      found.push_back(family.name);
    return found;
  };
  EXPECT_EQ(names("adaptive"), (std::vector<std::string>{"uniform", "planted"}));
  EXPECT_EQ(names("defect:vv"), (std::vector<std::string>{"uniform", "planted", "v-uniform~drawn"}));
  EXPECT_EQ(names("defect:contact"), (std::vector<std::string>{"uniform", "planted", "uniform~drawn",
                                                               "planted~drawn", "v-uniform~drawn"}));
}

}  // namespace
}  // namespace nearmiss
