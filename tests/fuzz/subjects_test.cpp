// Tests how subjects are found by name, and the oracle as a subject.
#include "fuzz/subjects/subjects.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "fuzz/subjects/contracted.hpp"
#include "fuzz/subjects/exact.hpp"
#include "tests/queries.hpp"
#include "tests/refused.hpp"

namespace nearmiss {
namespace {

TEST(AllSubjects, AreThoseOfTheCcdTheExactOnesAndThreeOthersButNoDefects) {
  EXPECT_EQ(built_in_subjects().size(), subjects().size() + exact_subjects().size() + 3);
  for (const SubjectInfo& info : built_in_subjects())
    EXPECT_EQ(make_any_subject(info.name)->name(), info.name);
  EXPECT_REFUSED(make_any_subject("wong"), "exact");
  for (const char* name : {"exact", "adaptive", "parity", "advance"})
    EXPECT_REFUSED(make_any_subject(std::string(name) + ":h=0.1"), "found 'h=0.1', expected no options");
  EXPECT_EQ(make_any_subject("defect:vv")->name(), "defect:vv");
  for (const SubjectInfo& info : built_in_subjects()) EXPECT_FALSE(info.name.starts_with("defect:"));
}

TEST(ExactSubject, AnswersWithoutAnyTolerance) {
  const auto exact = make_any_subject("exact");
  EXPECT_TRUE(exact->decide(testing::falling_vertex(0.5, 0.5, 1, 0)).hit);
  EXPECT_FALSE(exact->decide(testing::falling_vertex(0.5, 0.5, 1, 0x1p-1074)).hit);
  EXPECT_TRUE(exact->decide(Query{}).hit);
  EXPECT_EQ(exact->distance_bound(Query{}), 0);
}

TEST(ExactSubject, AnswersEachOfManyQueries) {
  std::vector<Query> queries;
  for (int i = 0; i < 300; ++i)
    queries.push_back(testing::falling_vertex(0.25, 0.25, 1, i % 3 == 0 ? 0.5 : -0.5));
  for (const SubjectInfo& info : exact_subjects()) {
    std::vector<Verdict> verdicts(queries.size());
    make_any_subject(info.name)->decide(queries, verdicts);
    for (std::size_t i = 0; i < queries.size(); ++i)
      EXPECT_EQ(verdicts[i].hit, i % 3 != 0) << info.name << ' ' << i;
  }
}

/// The vertex goes through the triangle and back. The subject `parity`, which finds whether the number of
/// roots is odd, cannot distinguish two roots from none.
TEST(ParitySubject, CannotSeeAnEvenNumberOfRoots) {
  const auto parity = make_any_subject("parity");
  const Query back = query_of(Kind::vertex_triangle,
                              std::array{-0.375, -0.3125, 0.25, 0., 0., 0., 1., -1., 0., 1.,  0., 1.,  //
                                         1.125,  0.4375,  0.25, 0., 0., 0., 1., 1.,  0., -1., 0., 1.}
                                  .data());
  EXPECT_TRUE(make_any_subject("exact")->decide(back).hit);
  EXPECT_FALSE(parity->decide(back).hit);
  EXPECT_FALSE(keeps_contract(back, parity->contract()));
  const Query once = testing::falling_vertex(0.5, 0.5, 1, -1);  // contact on the border
  EXPECT_TRUE(parity->decide(once).hit);
  EXPECT_TRUE(keeps_contract(once, parity->contract()));
  EXPECT_EQ(parity->distance_bound(once), 0);
  EXPECT_FALSE(parity->decides(Kind::vertex_edge));
}

TEST(AllSubjects, RefuseCoordinatesThatAreNotFinite) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<std::string> names{"defect:vv", "wang:float", "basic:p80", "wang@2"};
  for (const SubjectInfo& info : built_in_subjects()) names.emplace_back(info.name);
  for (const std::string& name : names) {
    const auto subject = make_any_subject(name);
    for (const double c : {infinity, -infinity, std::nan("")})
      // A collision for end = -1, and a pair that a plane separates for end = 2.
      for (const double end : {-1.0, 2.0})
        for (const std::size_t i : {0U, 5U, 13U, 23U}) {
          Query query = testing::falling_vertex(0.25, 0.25, 1, end);
          query.x[i] = c;
          EXPECT_REFUSED(subject->decide(query), "not finite") << name << ' ' << i;
        }
  }
}

}  // namespace
}  // namespace nearmiss
