// nearmiss subjects.
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using testing::CommandLine;
using ::testing::HasSubstr;

TEST_F(CommandLine, SubjectsAreListed) {
  const Output output = run("subjects");
  for (const char* name :
       {"basic ", "basic-plain ", "wang ", "wang-eps ", "wang-plain ", "exact ", "defect:vv "})
    EXPECT_THAT(output.out, HasSubstr(name));
}

TEST_F(CommandLine, OnlyPluginsAreDescribed) {
  expect_refused("subjects wang", {"found 'wang', expected a plug-in"});
}

TEST_F(CommandLine, DetectorsOfAPluginAreDescribed) {
  const Output output = run("subjects " + plugin("several") + " " + plugin("sampling"));
  EXPECT_EQ(output.code, 0) << output.error;
  EXPECT_THAT(output.out, HasSubstr("told                    answers what its option says\n"));
  EXPECT_THAT(output.out, HasSubstr("version 7; vt and ee; 53 bits; no time; batches of 1\n"));
  EXPECT_THAT(output.out, HasSubstr("ee; 53 bits; a lower bound of the time; batches of 1\n"));
  EXPECT_THAT(output.out,
              HasSubstr("batches of 64\n                        presumes: the primitives are apart at t = 0; "
                        "coordinates are multiples of 0.0009765625; edges and paths are at most 2 long\n"));
}

}  // namespace
}  // namespace nearmiss
