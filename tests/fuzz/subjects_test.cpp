// Subjects by name.
#include "fuzz/subjects/subjects.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ccd/error.hpp"

namespace nearmiss {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(AllSubjects, AreThoseOfTheCcdTheExactOnesAndAdaptive) {
  EXPECT_EQ(all_subjects().size(), subjects().size() + 3);
  for (const SubjectInfo& info : all_subjects()) EXPECT_EQ(make_any_subject(info.name)->name(), info.name);
  EXPECT_THAT([] { make_any_subject("wong"); }, ThrowsMessage<Error>(HasSubstr("exact")));
}

TEST(AllSubjects, AreNoDefects) {
  for (const SubjectInfo& info : all_subjects()) EXPECT_FALSE(info.name.starts_with("defect:"));
  EXPECT_EQ(make_any_subject("defect:vv")->name(), "defect:vv");
}

}  // namespace
}  // namespace nearmiss
