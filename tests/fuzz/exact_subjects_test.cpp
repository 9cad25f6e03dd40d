// The oracle as a subject.
#include "fuzz/subjects/exact.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "ccd/query/error.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(ExactSubject, AnswersWithoutAnyTolerance) {
  const auto exact = try_make_exact("exact");
  EXPECT_TRUE(exact->decide(testing::falling_vertex(0.5, 0.5, 1, 0)).hit);
  EXPECT_FALSE(exact->decide(testing::falling_vertex(0.5, 0.5, 1, 0x1p-1074)).hit);
  EXPECT_TRUE(exact->decide(Query{}).hit);
  EXPECT_EQ(exact->distance_bound(Query{}), 0);
}

TEST(ExactSubject, AnswersEachOfManyQueries) {
  std::vector<Query> queries;
  for (int i = 0; i < 1000; ++i)
    queries.push_back(testing::falling_vertex(0.25, 0.25, 1, i % 3 == 0 ? 0.5 : -0.5));
  for (const SubjectInfo& info : exact_subjects()) {
    std::vector<Verdict> verdicts(queries.size());
    try_make_exact(info.name)->decide(queries, verdicts);
    for (std::size_t i = 0; i < queries.size(); ++i)
      EXPECT_EQ(verdicts[i].hit, i % 3 != 0) << info.name << ' ' << i;
  }
}

TEST(ExactSubject, RefusesWhatIsNotFinite) {
  Query query;
  query.x[7] = std::numeric_limits<double>::infinity();
  EXPECT_THAT([&] { static_cast<void>(try_make_exact("exact")->decide(query)); },
              ThrowsMessage<Error>(HasSubstr("not finite")));
}

TEST(ExactSubject, HasAScalarTwin) {
  for (const SubjectInfo& info : exact_subjects()) EXPECT_EQ(try_make_exact(info.name)->name(), info.name);
  EXPECT_EQ(try_make_exact("wang"), nullptr);
}

}  // namespace
}  // namespace nearmiss
