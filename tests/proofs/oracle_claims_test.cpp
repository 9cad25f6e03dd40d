// The table of bounds: each constant is at least the proven bound, which is at least the largest error seen.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tests/proofs/check.hpp"

namespace nearmiss::proofs {

void PrintTo(const OracleClaim& claim, std::ostream* out) { *out << claim.name; }

namespace {

std::string test_name(const ::testing::TestParamInfo<OracleClaim>& info) {
  std::string name = info.param.name;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

class ProofsOfClaims : public ::testing::TestWithParam<OracleClaim> {};
INSTANTIATE_TEST_SUITE_P(Oracle, ProofsOfClaims, ::testing::ValuesIn(oracle_claims()), test_name);

TEST_P(ProofsOfClaims, HoldAndTheirWitnessesShowHowNearly) {
  const OracleClaim& claim = GetParam();
  static const auto witnesses = read_witnesses(NEARMISS_WITNESSES "/oracle.txt");
  ASSERT_TRUE(witnesses.contains(claim.name)) << "find one: proofs_table --search-oracle 20000";
  EXPECT_THAT(faults(claim, witnesses.at(claim.name)), ::testing::IsEmpty());
}

TEST(ProofsOfTheOracle, AClaimBelowItsProofIsAFault) {
  OracleClaim claim = oracle_claims().front();
  const auto witnesses = read_witnesses(NEARMISS_WITNESSES "/oracle.txt");
  claim.claimed /= 2;
  EXPECT_THAT(faults(claim, witnesses.at(claim.name)),
              ::testing::ElementsAre(::testing::HasSubstr("is claimed")));
}

TEST(ProofsOfTheOracle, OfNoConstantHalfIsEnough) {
  std::map<std::string, double> share;  // proven / claimed
  for (const OracleClaim& claim : oracle_claims()) {
    double& largest = share[claim.constant()];
    largest = std::max(largest, claim.proven() / claim.claimed);
  }
  for (const auto& [name, largest] : share) EXPECT_GT(largest, 0.5) << name;
}

}  // namespace
}  // namespace nearmiss::proofs
