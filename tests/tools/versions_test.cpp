// Two versions of a CCD on the command line: their names, fixed and broken queries, and the replay of a
// broken query.
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using testing::CommandLine;
using ::testing::HasSubstr;
using ::testing::Not;

class VersionsOfACcd : public CommandLine {
 protected:
  VersionsOfACcd() {
    std::filesystem::copy(plugin("v1"), file("v1.so"));
    std::filesystem::copy(plugin("v2"), file("v2.so"));
  }

  /// The sum of a number over all classes and kinds.
  static std::uint64_t sum(const nlohmann::json& versions, const char* of) {
    std::uint64_t sum = 0;
    for (const auto& each : versions) sum += each[of].get<std::uint64_t>();
    return sum;
  }
};

TEST_F(VersionsOfACcd, AreNamedAsTheirFilesAndCompared) {
  const Output output =
      expect_code(1, "fuzz --subject ./v1.so,./v2.so --family small-integer,uniform --cases 400 --db a.db");
  EXPECT_THAT(output.out, HasSubstr("v2 against v1: "));
  EXPECT_THAT(output.out, HasSubstr("v1 answers rightly, and v2 does not:"));
  const auto report = report_of("a.db", 1);
  const auto& versions = report["versions"];
  EXPECT_EQ(sum(versions, "queries"), 400);
  EXPECT_EQ(
      sum(versions, "fixed") + sum(versions, "broken") + sum(versions, "both") + sum(versions, "neither"),
      400);
  const auto missed_by = [&](const char* subject) {
    return report["subjects"][subject]["vt"]["false_negatives"].get<std::uint64_t>() +
           report["subjects"][subject]["ee"]["false_negatives"].get<std::uint64_t>();
  };
  EXPECT_EQ(sum(versions, "both") + sum(versions, "fixed"), missed_by("v1"));
  EXPECT_EQ(sum(versions, "both") + sum(versions, "broken"), missed_by("v2"));
  EXPECT_GT(sum(versions, "fixed"), 0);
  EXPECT_GT(sum(versions, "broken"), 0);
}

TEST_F(VersionsOfACcd, SayWhichKindIsNotCompared) {
  const Output output =
      run("fuzz --subject " + plugin("several") + ":edges,wang,never=" + plugin("never_asked") +
          " --versions wang,never --family uniform --cases 20 --db a.db");
  EXPECT_THAT(output.out,
              HasSubstr("never against wang: no query was asked of both; vt not compared, because "
                        "never was not asked about it; ee not compared, because never was not"));
  const auto versions = report_of("a.db", output.code)["versions"];
  EXPECT_FALSE(versions.empty());
  EXPECT_EQ(sum(versions, "queries"), 0);
  EXPECT_THAT(run("fuzz --subject ./v1.so,old=" + plugin("v3") + " --family uniform --cases 20").out,
              HasSubstr("; ee not compared, because old was not asked about it\n"));
  EXPECT_THAT(run("fuzz --subject ./v1.so,./v2.so,wang --family uniform --cases 20").out,
              Not(HasSubstr("not compared")));
}

TEST_F(VersionsOfACcd, ThatAreProgramsAreNamedAndReplayedByTheirFiles) {
  std::string program = read(NEARMISS_EXAMPLES "/example.py");
  program.replace(program.find("~apart.any(1)"), 1, "");  // misses all collisions
  for (const char* folder : {"lib", "elsewhere"}) std::filesystem::create_directory(file(folder));
  for (const char* version : {"one.py", "lib/two.py"}) write(version, program);
  const std::string python = "pipe:" NEARMISS_PYTHON " ";
  const Output output = run("fuzz --subject '" + python + "one.py," + python +
                            "lib/two.py 2>/dev/null # *' --family small-integer --cases 40 --db a.db");
  EXPECT_THAT(output.out, HasSubstr("two against one: "));
  const auto findings = report_of("a.db", output.code)["findings"];
  ASSERT_FALSE(findings.empty());
  for (const auto& finding : {findings.front(), findings.back()}) {
    const std::string again = std::string(finding["again"]).substr(std::string("nearmiss replay ").size());
    expect_code(1, "replay ../report/" + again, "cd elsewhere &&");
    expect_code(1, "replay report/" + again);
  }
  expect_refused("bench --subject '" + python + "one.py," + python + "one.py'",
                 {"such as 'NAME=pipe:" NEARMISS_PYTHON " one.py'"});
  // A word too long for a file name must not be taken for a file.
  expect_refused("bench --subject '" + python + "one.py," + python + "one.py " + std::string(300, 'x') + "'",
                 {"two subjects named"});
}

TEST_F(VersionsOfACcd, AreReplayedUnderTheirNames) {
  expect_code(1, "fuzz --subject old=./v1.so,new=./v2.so --family uniform --cases 400 --db a.db");
  const auto findings = report_of("a.db", 1)["findings"];
  for (const auto& finding : findings) {
    if (!finding.contains("broken_since")) continue;
    const std::string again = finding["again"];
    EXPECT_THAT(again,
                HasSubstr(" --subject old=" + file("v1.so").string() + ",new=" + file("v2.so").string()));
    std::filesystem::copy(file("report") / finding["original_file"], file("broken.case"));
    const std::string subjects = again.substr(again.find(" --subject"));
    const Output output = run("replay broken.case" + subjects);
    EXPECT_THAT(output.out, HasSubstr("new against old: 0 fixed, 1 broken, 0 both fail, of 1 query"));
    return;
  }
  FAIL() << "no finding is broken";
}

TEST_F(VersionsOfACcd, MergeToTheSameComparison) {
  const std::string fuzz =
      "fuzz --subject ./v1.so,./v2.so --family small-integer --cases 1000 --no-shrink -q ";
  const auto whole = json_of(1, fuzz)["versions"];
  for (const std::string shard : {"0", "1"})
    expect_code(1, fuzz + "--db " + shard + ".db --shard " + shard + "/2");
  expect_code(1, "merge all.db 1.db 0.db");
  EXPECT_EQ(report_of("all.db", 1)["versions"], whole);
}

TEST_F(VersionsOfACcd, CanBeChosenByDifferentNames) {
  const std::string fuzz = "fuzz --subject basic,other=wang --family uniform --cases 100 --versions ";
  EXPECT_THAT(run(fuzz + "basic,other").out, HasSubstr("other against basic: "));
  expect_refused(fuzz + "basic,wang", {"--versions: found 'wang'"});
  expect_refused(fuzz + "basic,basic", {"--versions: found 'basic' twice, expected two subjects"});
  expect_refused("fuzz --cases 10 --subject ./v1.so,./v1.so --db new.db",
                 {"found two subjects named 'always', expected different names, such as NAME=./v1.so"});
}

TEST_F(VersionsOfACcd, AreRenamedForEveryCommand) {
  EXPECT_EQ(run("subjects new=./v1.so").out.substr(0, 4), "new ");
  EXPECT_EQ(run("subjects --targets new=./v1.so").out, "false_negative new=./v1.so\n");
  EXPECT_THAT(run("verdict --kind vt --subject new=" + plugin("error") + " hit.vt").error,
              HasSubstr("new: no answer"));
  EXPECT_THAT(run("shrink hit.vt --subject new=" + plugin("never")).out, HasSubstr("false-negative of new"));
  EXPECT_THAT(run("scene spikes@100 --bound pair,scene --subject old=wang,./v1.so,./v2.so").out,
              ::testing::AllOf(HasSubstr("old@scene: "), HasSubstr("v2 against v1: ")));
  EXPECT_THAT(run("bench hit.vt --queries 1 --runs 1 --subject ./v1.so,./v2.so").out, HasSubstr(" v2 "));
}

}  // namespace
}  // namespace nearmiss
