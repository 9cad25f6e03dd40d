// Subjects by name.
#include "fuzz/subjects/subjects.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "ccd/error.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(AllSubjects, AreThoseOfTheCcdTheExactOnesAndAdaptive) {
  EXPECT_EQ(built_in_subjects().size(), subjects().size() + 4);
  for (const SubjectInfo& info : built_in_subjects())
    EXPECT_EQ(make_any_subject(info.name)->name(), info.name);
  EXPECT_THAT([] { make_any_subject("wong"); }, ThrowsMessage<Error>(HasSubstr("exact")));
}

TEST(AllSubjects, RefuseCoordinatesThatAreNotFinite) {
  std::vector<std::string> names{"defect:vv", "wang:float", "basic:p80", "wang@2"};
  for (const SubjectInfo& info : built_in_subjects()) names.emplace_back(info.name);
  for (const std::string& name : names) {
    const auto subject = make_any_subject(name);
    for (const double c : {std::numeric_limits<double>::infinity(), std::nan("")})
      for (std::size_t i = 0; i < 24; ++i) {
        Query query = testing::falling_vertex(0.25, 0.25, 1, -1);
        query.x[i] = c;
        EXPECT_THAT([&] { (void)subject->decide(query); }, ThrowsMessage<Error>(HasSubstr("not finite")))
            << name << ' ' << i;
      }
  }
}

TEST(AllSubjects, AreNoDefects) {
  for (const SubjectInfo& info : built_in_subjects()) EXPECT_FALSE(info.name.starts_with("defect:"));
  EXPECT_EQ(make_any_subject("defect:vv")->name(), "defect:vv");
}

}  // namespace
}  // namespace nearmiss
