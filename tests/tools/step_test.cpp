// nearmiss step, as a user sees it.
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using testing::CommandLine;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class Step : public CommandLine {
 protected:
  static std::string steps(int defect) {
    return "step --subject " + plugin("steps") + ":defect=" + std::to_string(defect) + " ";
  }
};

TEST_F(Step, OfASafeFilterShowsWhatItKeeps) {
  const Output output = expect_code(0, steps(0) + "--cases 4000 --json new.json");
  EXPECT_THAT(output.out, HasSubstr("kept, median"));
  EXPECT_THAT(output.out, Not(HasSubstr("the simplest failures")));
  const json of_kinds = read_json("new.json")["subjects"]["steps:defect=0"];
  EXPECT_EQ(of_kinds.size(), 4U);
  for (const auto& counts : of_kinds) {
    EXPECT_EQ(counts["unsafe"], 0);
    EXPECT_GT(counts["queries"], 200);
  }
}

TEST_F(Step, ThatIsUnsafeIsShownWithTheSimplestQuery) {
  const Output output = expect_code(1, steps(5) + "--cases 2000 --kind vt --json new.json");
  EXPECT_THAT(output.out, HasSubstr("ordinary: unsafe: "));
  const json finding = read_json("new.json")["findings"][0];
  EXPECT_EQ(finding["class"], "ordinary");
  write("query", finding["query"].get<std::string>() + "\n");
  const Output again = expect_code(1, steps(5) + "--kind vt query");
  EXPECT_THAT(again.out, StartsWith("unsafe " + finding["answer"].get<std::string>()));
  EXPECT_THAT(expect_code(0, steps(0) + "--kind vt query").out, StartsWith("right "));
  write("certificate", finding["certificate"].get<std::string>() + "\n");
  const std::string check = NEARMISS_PYTHON " " NEARMISS_CHECKER " " + file("certificate").string();
  EXPECT_EQ(std::system((check + " >" + file("said").string()).c_str()), 0) << read("said");
}

TEST_F(Step, NeedsAFilter) {
  expect_refused("step --subject wang --cases 10 --json new.json",
                 {"wang: found no function step", "expected a plug-in that has it"});
}

}  // namespace
}  // namespace nearmiss
