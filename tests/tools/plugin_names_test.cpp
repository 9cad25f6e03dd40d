// Tests what a run stores about subjects: limits of plug-ins, and names with which findings can be replayed.
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using testing::CommandLine;
using ::testing::EndsWith;
using ::testing::HasSubstr;

/// The command that replays the first finding of a campaign with a subject that misses something.
class ReplayOfASubject : public CommandLine {
 protected:
  [[nodiscard]] std::string command(const std::string& subject) const {
    const std::string options = "--family small-integer --cases 200 --db a.db --subject ";
    EXPECT_EQ(run("fuzz " + options + "'" + subject + "'").code, 1);
    return report_of("a.db", 1)["findings"][0]["again"];
  }
};

TEST_F(ReplayOfASubject, HasTheOptionsOfABuiltInSubject) {
  const std::string subject = "mine=bridson:thickness=0:barycentric=1e-3";
  const std::string again = command(subject);
  EXPECT_THAT(again, EndsWith(" --subject " + subject));
  EXPECT_EQ(run(again.substr(9), "cd report &&").code, 1);
}

TEST_F(ReplayOfASubject, HasTheWholePathAndTheOptionsOfAPluginAsTheyWereGiven) {
  const std::string options = ":told:answer=0/../x";
  std::filesystem::copy(plugin("several"), file("a.so"));
  const std::string again = command("./a.so" + options);
  EXPECT_THAT(again, HasSubstr(" --subject " + file("a.so").string() + options + " --query-time"));
  EXPECT_EQ(run(again.substr(9), "cd report &&").code, 1);
}

TEST_F(ReplayOfASubject, HasTheCommandOfAProgramAsItWasGiven) {
  write("p.py",
        "import sys\n"
        "sys.stdout.write('nearmiss 3\\nname p\\nkinds vt ee\\n\\n')\n"
        "sys.stdout.flush()\n"
        "while sys.stdin.buffer.read(24 + 200):\n"
        "    sys.stdout.buffer.write(bytes(16))\n"
        "    sys.stdout.buffer.flush()\n");
  const std::string subject = "pipe:" NEARMISS_PYTHON " " + file("p.py").string();
  const std::string again = command(subject);
  EXPECT_THAT(again, HasSubstr(" --subject '" + subject + "' --query-time"));
  EXPECT_EQ(run(again.substr(9), "cd report &&").code, 1);
}

TEST_F(CommandLine, APluginMayBeInAnyFolder) {
  const std::string folder = "a\nb";
  std::filesystem::create_directory(file(folder));
  std::filesystem::copy(plugin("never"), file(folder) / "never.so");
  const std::string fuzz = "fuzz --family small-integer --cases 200 --db a.db --subject ./never.so ";
  const std::string there = "cd '" + folder + "' &&";
  EXPECT_EQ(run(fuzz, there).code, 1);
  EXPECT_EQ(run(fuzz + "--resume", there).code, 1);
  EXPECT_EQ(run("report a.db -o report", there).code, 1);
  const std::string again = read_json(folder + "/report/report.json")["findings"][0]["again"];
  EXPECT_THAT(again, HasSubstr(" --subject ./never.so "));  // a store has no line ends
}

TEST_F(CommandLine, TheLimitsOfAPublishedCcdAreThoseOfItsRun) {
  if (run("subjects --peers").out.find("fcl\n") == std::string::npos) GTEST_SKIP() << "found no libfcl-dev";
  const std::string fuzz = "fuzz --subject fcl --cases 200 --db a.db --query-memory 2G --query-time ";
  EXPECT_LE(run(fuzz + "7s").code, 1);
  expect_refused(fuzz + "8s --resume", {"found a run with query-time '7s', expected '8s'"});
  EXPECT_LE(run("report a.db -o report").code, 1);
  const std::string again = read_json("report/report.json")["runs"][0]["again"];
  EXPECT_THAT(again, HasSubstr(" --query-time 7s --query-memory 2147483648"));
}

}  // namespace
}  // namespace nearmiss
