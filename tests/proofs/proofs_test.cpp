// Every claim of the table is proven, and the proofs can fail.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fuzz/studies/audit.hpp"
#include "tests/proofs/ccd_problems.hpp"
#include "tests/proofs/check.hpp"

namespace nearmiss::proofs {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::map<std::string, Witness>& witnesses() {
  static const auto all = read_witnesses(NEARMISS_WITNESSES "/ccd.txt");
  return all;
}

CcdClaim claim_of(std::string_view name) {
  for (const CcdClaim& claim : ccd_claims())
    if (claim.name == name) return claim;
  throw std::invalid_argument("no such claim");
}

std::vector<std::string> faults_of(const CcdClaim& claim, const Witness& witness) {
  Prover prover;
  return faults(claim, witness, prover);
}

TEST(ProofsClaims, HoldInEveryPrecisionAndAtTheirWitnesses) {
  EXPECT_THAT(faults(ccd_claims(), witnesses()), IsEmpty());
}

TEST(ProofsClaims, HaveNamesOfTheirOwnAndAWitnessEach) {
  std::vector<std::string> names;
  for (const CcdClaim& claim : ccd_claims()) names.emplace_back(claim.name);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
  std::vector<std::string> seen;
  for (const auto& [name, witness] : witnesses()) seen.push_back(name);
  EXPECT_EQ(names, seen);
}

// If a script left out a part of its formula, Gappa could prove a bound below an error that was seen.
TEST(ProofsClaims, HaveNoProofOfLessThanAnErrorThatIsThere) {
  Prover prover;
  for (const CcdClaim& claim : ccd_claims()) {
    const double best = prover.error(claim.problem(), {53, {}, claim.vectors_alone});
    EXPECT_GE(best * 0x1p52, witnesses().at(std::string(claim.name)).error) << claim.name;
  }
}

TEST(ProofsClaims, FailWhereLessIsClaimedThanProven) {
  CcdClaim claim = claim_of("VT: N");
  claim.claimed = claim.proven * 0.999;
  EXPECT_THAT(faults_of(claim, witnesses().at("VT: N")), ElementsAre(HasSubstr("is claimed")));
}

TEST(ProofsClaims, FailWhereGappaProvesNoSuchBound) {
  CcdClaim claim = claim_of("VT: N");
  claim.proven = 10.01;  // 10.02 with 11 bits
  EXPECT_THAT(faults_of(claim, witnesses().at("VT: N")),
              ElementsAre("VT: N: Gappa does not prove 10.01 with 11 bits"));
  claim.proven = 9.99;
  EXPECT_EQ(faults_of(claim, witnesses().at("VT: N")).size(), std::size(precisions) + 1);
}

TEST(ProofsClaims, FailWhereTheFormulaIsAnother) {
  CcdClaim claim = claim_of("VT: N");
  claim.problem = [] {
    Problem problem = configuration(Kind::vertex_triangle, Reach::near, ConfigurationPart::normal);
    problem.left *= 1 + Traced(0x1p-5);  // one more rounding
    return problem;
  };
  EXPECT_THAT(faults_of(claim, witnesses().at("VT: N")), Not(IsEmpty()));
}

TEST(ProofsClaims, FailWhereMoreIsSeenThanProven) {
  CcdClaim claim = claim_of("VV: v.v");
  claim.proven = 3;
  EXPECT_THAT(faults_of(claim, witnesses().at("VV: v.v")),
              ::testing::Contains(HasSubstr("is seen, 3 proven")));
}

TEST(ProofsClaims, FailWhereTheWitnessHasAnotherError) {
  const CcdClaim claim = claim_of("VV: v.v");
  Witness witness = witnesses().at("VV: v.v");
  witness.error = std::nextafter(witness.error, 0);
  EXPECT_THAT(faults_of(claim, witness), ElementsAre(HasSubstr("the witness has an error of")));
}

TEST(ProofsClaims, CoverEveryBoundOfTheAudit) {
  for (const RoundingConstant& row : rounding_bounds())
    EXPECT_EQ(claim_of(row.name).proven, row.proven) << row.name;
}

}  // namespace
}  // namespace nearmiss::proofs
