// Tests that every claim of the table is proven, and that wrong claims are not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "fuzz/studies/audit.hpp"
#include "tests/proofs/claims.hpp"

namespace nearmiss::proofs {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const Witnesses& witnesses() {
  static const auto all = read_witnesses(NEARMISS_WITNESSES);
  return all;
}

CcdClaim claim_of(std::string_view name) {
  for (const CcdClaim& claim : ccd_claims())
    if (claim.name == name) return claim;
  throw std::invalid_argument("no such claim");
}

TEST(ProofsClaims, HoldInEveryPrecisionAndAtTheirWitnesses) {
  EXPECT_THAT(faults(ccd_claims(), witnesses()), IsEmpty());
}

TEST(ProofsClaims, AboutTheOracleHoldAtTheirWitnessesAndNoConstantCouldBeHalved) {
  std::map<std::string, double> share;  // proven / claimed
  for (OracleClaim claim : oracle_claims()) {
    const double proven = claim.proven();
    claim.proven = [proven] { return proven; };
    EXPECT_THAT(faults(claim, witnesses().at(claim.name)), IsEmpty());
    double& largest = share[claim.constant()];
    largest = std::max(largest, proven / claim.claimed);
  }
  for (const auto& [name, largest] : share) EXPECT_GT(largest, 0.5) << name;
}

TEST(ProofsClaims, HaveNamesOfTheirOwnAndAWitnessEach) {
  std::vector<std::string> names;
  for (const CcdClaim& claim : ccd_claims()) names.emplace_back(claim.name);
  for (const OracleClaim& claim : oracle_claims()) names.push_back(claim.name);
  std::sort(names.begin(), names.end());
  std::vector<std::string> seen;
  for (const auto& [name, witness] : witnesses()) seen.push_back(name);
  EXPECT_EQ(names, seen);
}

TEST(ProofsClaims, FailWhereTheyAreWrong) {
  Prover prover;
  const CcdClaim right = claim_of("VV: v.v");
  const Witness seen = witnesses().at("VV: v.v");
  const auto faults_with = [&](const std::function<void(CcdClaim&)>& change) {
    CcdClaim claim = right;
    change(claim);
    return faults(claim, seen, prover);
  };
  EXPECT_THAT(faults_with([](CcdClaim& claim) { claim.claimed = claim.proven * 0.999; }),
              ElementsAre(HasSubstr("is claimed")));
  EXPECT_THAT(faults_with([](CcdClaim& claim) { claim.proven = 4.001; }),
              ElementsAre("VV: v.v: Gappa does not prove 4.001 with 11 bits"));
  EXPECT_EQ(faults_with([](CcdClaim& claim) { claim.proven = 3.99; }).size(), std::size(precisions) + 1);
  EXPECT_THAT(faults_with([](CcdClaim& claim) { claim.proven *= 2; }),
              ElementsAre(HasSubstr("far below 8.04")));
  EXPECT_THAT(faults_with([](CcdClaim& claim) { claim.proven = 3; }),
              Contains(HasSubstr("is seen, 3 proven")));
  EXPECT_THAT(faults_with([&](CcdClaim& claim) {  // one more rounding
                claim.problem = [&] {
                  Problem problem = right.problem();
                  problem.left *= 1 + Traced(0x1p-5);
                  return problem;
                };
              }),
              Contains(HasSubstr("Gappa does not prove")));
  EXPECT_THAT(faults_with([&](CcdClaim& claim) {  // a problem without rounded products and sums
                claim.problem = [&] {
                  Problem problem = right.problem();
                  problem.left = problem.motions[0].vector.xv[3] * 1;
                  return problem;
                };
              }),
              Contains(HasSubstr("is seen, but Gappa proves")));
  Witness other = seen;
  other.error = std::nextafter(other.error, 0);
  EXPECT_THAT(faults(right, other, prover), ElementsAre(HasSubstr("the witness has an error of")));
}

TEST(ProofsClaims, AboutTheOracleFailWhereLessIsClaimedThanProven) {
  OracleClaim claim = oracle_claims().front();
  claim.claimed /= 2;
  EXPECT_THAT(faults(claim, witnesses().at(claim.name)), ElementsAre(HasSubstr("is claimed")));
}

TEST(ProofsClaims, CoverEveryBoundOfTheAudit) {
  for (const RoundingConstant& row : rounding_bounds())
    EXPECT_EQ(claim_of(row.name).proven, row.proven) << row.name;
}

}  // namespace
}  // namespace nearmiss::proofs
