// nearmiss demo, nearmiss completion, and the first example of README.md.
#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

class DemoTest : public testing::CommandLine {
 protected:
  /// The words that bash offers as completions of the last word of this command line.
  [[nodiscard]] std::string completed(const std::string& words) const {
    (void)run("completion bash", "", "&& cp out.txt completion");
    const std::string command =
        "cd " + file("").string() + " && bash -c 'source ./completion; COMP_WORDS=(" + words +
        "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _nearmiss; echo \"${COMPREPLY[*]}\"' >words.txt";
    EXPECT_EQ(std::system(command.c_str()), 0) << words;
    return read("words.txt");
  }
};

TEST_F(DemoTest, ShowsAMissThatCanBeReplayed) {
  const Output output = expect_code(0, "demo -o 'a miss.case'");
  EXPECT_THAT(output.out,
              AllOf(ContainsRegex("of ordinary families, it has missed [0-9]+ collision"),
                    ContainsRegex("of degenerate and extreme families, basic has missed [0-9]+ collision"),
                    HasSubstr("wang, the failure-proof CCD, reports it."), ContainsRegex("\n  +[ .o#]*[0-3]"),
                    HasSubstr("nearmiss replay 'a miss.case' --subject bridson:thickness=0,wang\n")));
  std::istringstream lines(output.out);
  for (std::string line; std::getline(lines, line);)
    EXPECT_TRUE(line.size() <= 100 || line.starts_with("  x")) << line;
  const Output replayed = expect_code(1, "replay 'a miss.case' --subject bridson:thickness=0,wang,basic");
  EXPECT_THAT(replayed.out,
              AllOf(ContainsRegex("^FAIL bridson:thickness=0: MISSED the collision\n ok  basic: reports the "
                                  "collision.*\n ok  wang: reports the collision\n"),
                    HasSubstr("; ordinary "), HasSubstr(" --subject bridson:thickness=0 --as c++\n")));
}

TEST_F(DemoTest, SaysThatItCannotWrite) {
  expect_refused("demo -o no/folder.case", {"no/folder.case"});
  EXPECT_THAT(run("demo -o no/folder.case").out, ::testing::Not(HasSubstr("missed")));
  expect_refused("demo -o miss.txt", {"found 'miss.txt', expected a name that ends in .case"});
}

TEST_F(DemoTest, BashCompletesCommandsOptionsAndLists) {
  for (const auto& [words, completions] : std::vector<std::pair<std::string, std::string>>{
           {"shr", "shrink"},
           {"fuzz --subj", "--subject"},
           {"fuzz --subject basic,wang-t", "basic,wang-tight basic,wang-time"},
           {"fuzz --family uniform-e", "uniform-end"},
           {"fuzz --subject = ba", "basic basic-plain"},  // as in --subject=ba
           {"fuzz --sweep asp", "aspect"},
           {"fuzz --sweep uniform-e", ""},  // this family has no parameter
           {"fuzz --subject wang,./compl", "wang,./completion"}})
    EXPECT_EQ(completed("nearmiss " + words), completions + "\n");
  EXPECT_EQ(completed("nearmiss fuzz --subject ="), completed("nearmiss fuzz --subject \"\""));
  EXPECT_THAT(run("completion zsh").out, ::testing::StartsWith("#compdef nearmiss\n"));
  expect_refused("completion fish", {"found 'fish', expected bash or zsh"});
}

}  // namespace
}  // namespace nearmiss
