// Findings have certificates that prove that the subject is wrong.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "fuzz/families/families.hpp"
#include "fuzz/trial/certified.hpp"
#include "fuzz/trial/shrinking.hpp"
#include "oracle/agreement/checked.hpp"
#include "oracle/distance.hpp"
#include "tests/fuzz/made_up_subjects.hpp"
#include "tests/fuzz/trials.hpp"
#include "tests/queries.hpp"
#include "tools/certificates/check.hpp"

namespace nearmiss {
namespace {

using certificates::check;
using testing::Claims;
using testing::falling_vertex;
using testing::MadeUpSubject;
using testing::one;
using What = Finding::What;

/// The vertex meets the triangle at t = 1/2, and passes it.
const Query contact = falling_vertex(0.25, 0.25, 1, -1);
/// The vertex falls, and stays at least 2 away from the triangle.
const Query apart = falling_vertex(0.25, 0.25, 4, 2);

std::string certificate(What what, const Query& query, double time = 0, double bound = 0) {
  return certificate_of({.what = what,
                         .subject = "",
                         .family = "",
                         .query = query,
                         .provenance = "",
                         .shrunk = query,
                         .time = time,
                         .bound = bound});
}

TEST(FindingCertificate, OfAMissIsThatTheyMeet) {
  EXPECT_EQ(check(certificate(What::false_negative, contact)), statement_about(contact, "meets", {}, false));
  const Query near = with_separation(apart, 2.5);
  EXPECT_EQ(check(certificate(What::false_negative, near)), statement_about(near, "meets", {}, true));
}

TEST(FindingCertificate, OfALateTimeIsThatTheyMeetBeforeIt) {
  EXPECT_EQ(check(certificate(What::late, contact, 0.75)),
            statement_about(contact, "meets", {0, std::nextafter(0.75, 0)}, false));
  EXPECT_EQ(certificate(What::late, contact, 0.5), "");
  const Query near = with_separation(contact, 0.5);  // the primitives are nearer than 0.5 from t = 1/4 on
  EXPECT_EQ(check(certificate(What::late, near, 0.375)),
            statement_about(near, "meets", {0, std::nextafter(0.375, 0)}, true));
  EXPECT_EQ(certificate(What::late, near, 0.25), "");
}

TEST(FindingCertificate, OfARefutedBoundIsThatTheyAreFartherApart) {
  EXPECT_EQ(check(certificate(What::refuted_bound, apart, 0, 1.5)),
            statement_about(with_separation(apart, 1.5), "apart", {}, true));
  EXPECT_EQ(certificate(What::refuted_bound, apart, 0, 2), "");
  EXPECT_EQ(check(certificate(What::refuted_bound, with_separation(apart, 0.5), 0, 1)),
            statement_about(with_separation(apart, std::nextafter(1.5, 2)), "apart", {}, true));
}

/// A subject that takes separations, promises that its times are lower bounds, and claims a bound of 0. It
/// reports no collision for a third of the queries, fails to answer a third, and reports a collision at t = 1
/// for a third.
Subjects often_wrong() {
  const auto answer = [](const Query& query) {
    const auto third = static_cast<int>(std::fmod(std::abs(query.x[0]) * 1e6, 3));
    return third == 0   ? Verdict::rejected(Rejection::culled)
           : third == 1 ? Verdict{.fault = Fault::error}
                        : Verdict::accepted(Stage::unspecified, 1);
  };
  return one(std::make_unique<MadeUpSubject>(
      "wrong", answer, Claims{.time_sort = TimeSort::lower_bound, .takes_separation = true}));
}

/// Expects that each certificate is about the shrunk query of its finding. Returns the sorts of failure, each
/// with the claim that the certificate proves ("" for a fault).
std::set<std::pair<What, std::string>> claims_of(const std::vector<Finding>& findings) {
  std::set<std::pair<What, std::string>> claims;
  for (const Finding& each : findings) {
    const auto proven = check(each.certificate);
    EXPECT_TRUE(std::equal(proven.x.begin(), proven.x.end(), each.shrunk.x.begin(), each.shrunk.x.end()));
    EXPECT_EQ(proven.h, each.what == What::refuted_bound ? separation_and_bound(each.shrunk, each.bound)
                                                         : each.shrunk.separation);
    claims.emplace(each.what, each.what == What::fault ? "" : proven.claim);
  }
  return claims;
}

TEST(FindingCertificate, EveryKeptFindingHasOneBeforeAndAfterItIsShrunk) {
  const std::set<std::pair<What, std::string>> all_claims{{What::false_negative, "meets"},
                                                          {What::refuted_bound, "apart"},
                                                          {What::fault, ""},
                                                          {What::late, "meets"}};
  for (const auto& [family, count] : {std::pair("uniform", 250), std::pair("near-separation", 60)}) {
    const Subjects subjects = often_wrong();
    std::vector<Query> queries;
    for (int i = 0; i < count; ++i)
      queries.push_back(make_query(find_family(family), 1, static_cast<std::uint64_t>(2 * i)));
    TrialResult result = hold_trial(subjects, testing::batch_of(family, queries));
    const std::size_t all = result.findings.size();
    Shrinking shrinking(subjects, 1, Stop::never(), true);
    shrinking.sift(result);
    EXPECT_LT(result.findings.size(), all);
    EXPECT_EQ(claims_of(result.findings), all_claims) << family;
    shrinking.finish([] {});
    std::vector<Finding> shrunk;
    for (auto& [number, finding] : shrinking.take()) shrunk.push_back(std::move(finding));
    EXPECT_EQ(shrunk.size(), result.findings.size());
    EXPECT_TRUE(std::ranges::all_of(shrunk, &Finding::is_shrunk));
    EXPECT_EQ(claims_of(shrunk), all_claims) << family;
  }
}

}  // namespace
}  // namespace nearmiss
