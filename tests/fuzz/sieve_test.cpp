// The sieve keeps a few findings of each signature.
#include "fuzz/trial/sieve.hpp"

#include <gtest/gtest.h>

#include "fuzz/families/families.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "fuzz/trial/judge.hpp"
#include "fuzz/trial/signatures.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

using testing::falling_vertex;

Subjects basic() {
  Subjects subjects;
  subjects.push_back(make_subject("basic"));
  return subjects;
}

/// A finding that cannot be shrunk: a mismatch with a recorded truth.
Finding mismatch(const std::string& signature, int number) {
  const Query query = falling_vertex(0.25, 0.25, number, -1);
  return {Finding::What::truth_mismatch, "", "f", query, std::to_string(number), 0, signature, query};
}

std::vector<std::string> provenances(const std::vector<Finding>& findings) {
  std::vector<std::string> all;
  for (const Finding& finding : findings) all.push_back(finding.provenance);
  return all;
}

TEST(Sieve, KeepsTheFirstOfEverySignature) {
  const Subjects subjects = basic();
  const Stop& stop = Stop::never();
  Sieve sieve(subjects, 2, stop);
  std::vector<Finding> some{mismatch("a", 1), mismatch("a", 2), mismatch("b", 3)};
  sieve.sift(some);
  EXPECT_EQ(provenances(some), (std::vector<std::string>{"1", "2", "3"}));
  some = {mismatch("a", 4), mismatch("b", 5), mismatch("a", 6), mismatch("c", 7)};
  sieve.sift(some);
  EXPECT_EQ(provenances(some), (std::vector<std::string>{"4", "5", "7"}));
}

TEST(Sieve, CountsWhatWasKeptBefore) {
  const Subjects subjects = basic();
  const Stop& stop = Stop::never();
  Sieve sieve(subjects, 2, stop);
  const std::vector<Finding> before{mismatch("a", 1), mismatch("a", 2)};
  sieve.know(before);
  std::vector<Finding> some{mismatch("a", 3), mismatch("a", 4), mismatch("b", 5)};
  sieve.sift(some);
  EXPECT_EQ(provenances(some), (std::vector<std::string>{"3", "5"}));
}

/// The collisions of a family that basic misses.
std::vector<Finding> missed(const Subjects& subjects) {
  Batch batch{
      .kind = Kind::edge_edge, .family = "planted-ulp", .queries = {}, .truths = {}, .provenance = {}};
  for (std::uint64_t i = 1; i < 1000; i += 2)
    batch.queries.push_back(make_query(find_family("planted-ulp"), 1, i));
  batch.provenance = [](std::size_t i) { return std::to_string(i); };
  return hold_trial(subjects, batch).findings;
}

TEST(Sieve, ALateFindingHasTheTimeOfItsShrunkQuery) {
  Subjects subjects;
  subjects.push_back(make_any_subject(NEARMISS_PLUGINS "/promises.so"));  // always at t = 1/2
  const Query early = falling_vertex(0.3, 0.3, 0.1, -1);
  Finding finding{Finding::What::late, "always", "f", early, "f:1:0", 0.4, contact_signature(early), early};
  finding.time = 0.25;  // another one, to see that it is replaced
  std::vector<Finding> findings{finding};
  Sieve(subjects, 1, Stop::never()).sift(findings);
  ASSERT_EQ(findings.size(), 1);
  EXPECT_NE(findings.front().shrunk, early);
  EXPECT_EQ(findings.front().time, 0.5);
}

TEST(Sieve, ShrinksWhatItKeeps) {
  const Subjects subjects = basic();
  const Stop& stop = Stop::never();
  Sieve sieve(subjects, 2, stop);
  std::vector<Finding> findings = missed(subjects);
  const std::size_t before = findings.size();
  for (const Finding& finding : findings) EXPECT_EQ(finding.shrunk, finding.query);
  sieve.sift(findings);
  EXPECT_GT(findings.size(), 3);
  EXPECT_LT(findings.size(), before);
  for (const Finding& finding : findings) {
    EXPECT_NE(finding.shrunk, finding.query);
    EXPECT_EQ(Judge(*subjects.front()).failure(finding.shrunk), (Failure{finding.what, finding.signature}));
  }
}

TEST(Sieve, ShrinksNothingAfterARequestToStop) {
  const Subjects subjects = basic();
  const std::atomic<bool> requested{true};
  const Stop stop(requested);
  Sieve sieve(subjects, 2, stop);
  std::vector<Finding> findings = missed(subjects);
  sieve.sift(findings);
  EXPECT_GT(findings.size(), 3);
  for (const Finding& finding : findings) EXPECT_EQ(finding.shrunk, finding.query);
}

}  // namespace
}  // namespace nearmiss
