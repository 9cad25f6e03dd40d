// The table of bounds: each constant is at least what is proven, and no more has been seen than is proven.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tests/proofs/claim.hpp"
#include "tests/proofs/witness.hpp"

namespace nearmiss::proofs {

void PrintTo(const Claim& claim, std::ostream* out) { *out << claim.name; }

namespace {

std::string test_name(const ::testing::TestParamInfo<Claim>& info) {
  std::string name = info.param.name;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

class ProofsOfClaims : public ::testing::TestWithParam<Claim> {};
INSTANTIATE_TEST_SUITE_P(Oracle, ProofsOfClaims, ::testing::ValuesIn(oracle_claims()), test_name);

TEST_P(ProofsOfClaims, HoldAndTheirWitnessesShowHowNearly) {
  const Claim& claim = GetParam();
  const double proven = claim.proven();
  EXPECT_LE(proven, claim.claimed);
  static const auto witnesses = read_witnesses(NEARMISS_WITNESSES "/oracle.txt");
  ASSERT_TRUE(witnesses.contains(claim.name)) << "find one: proofs_table --search";
  const Witness& witness = witnesses.at(claim.name);
  EXPECT_EQ(claim.seen(witness.inputs), witness.seen);
  EXPECT_LE(witness.seen, proven);
  EXPECT_GT(witness.seen, 0);
}

/// The constant that a claim is about, without what it is claimed of.
std::string constant(const Claim& claim) { return claim.name.substr(0, claim.name.find(',')); }

TEST(ProofsOfTheOracle, OfNoConstantHalfIsEnough) {
  std::map<std::string, double> share;  // proven / claimed
  for (const Claim& claim : oracle_claims()) {
    double& largest = share[constant(claim)];
    largest = std::max(largest, claim.proven() / claim.claimed);
  }
  for (const auto& [name, largest] : share) EXPECT_GT(largest, 0.5) << name;
}

}  // namespace
}  // namespace nearmiss::proofs
