// Tests subjects on the command line: nearmiss subjects, contracts, and the names of subjects in the commands
// that replay findings.
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using testing::CommandLine;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::StartsWith;

TEST_F(CommandLine, SubjectsAreListedAndPublishedOnesDescribed) {
  const std::string listed = run("subjects").out;
  for (const char* line :
       {"basic ", "wang-eps ", "exact ", "bridson ", "defect:vv ",
        "fcl                     FCL's CCD of deformable meshes, with its solver for cubics\n",
        "bullet                  the CCD of Bullet's soft bodies, in single precision"})
    EXPECT_THAT(listed, HasSubstr(line));
  EXPECT_THAT(run("subjects --peers").out, StartsWith("fcl\nfcl-newton\nbullet\nbullet-double\n"));
  EXPECT_THAT(run("subjects fcl-newton").out, HasSubstr("vt and ee; 53 bits; an estimate of the time"));
  expect_refused("subjects wang", {"found 'wang', expected a plug-in", "or a published CCD"});
}

TEST_F(CommandLine, SubjectsHaveALibFuzzerTargetForEachPromise) {
  EXPECT_EQ(run("subjects --targets basic wang defect:middle " + plugin("sampling")).out,
            "false_negative basic\n"
            "false_negative wang\n"
            "refuted_bound wang\n"
            "false_negative defect:middle\n"
            "late defect:middle\n"
            "refuted_bound defect:middle\n"
            "false_negative " +
                plugin("sampling") + "\n");
  EXPECT_THAT(run("subjects --targets fcl-newton").out,
              MatchesRegex("false_negative /.*/peers/fcl.so:fcl-newton\n"));
  write("program.sh", R"(printf 'nearmiss 2\nname p\nkinds vt ee\n\n'; exec cat >/dev/null)");
  EXPECT_EQ(run("subjects --targets basic 'pipe:sh program.sh'").out, "false_negative basic\n");
  expect_refused("subjects --targets none", {"'none'"});
  expect_refused("subjects --targets wang wang", {"found two subjects named 'wang'"});
}

TEST_F(CommandLine, PublishedCcdsAreFoundBesideTheExecutable) {
  std::filesystem::copy_file(NEARMISS_EXECUTABLE, file("copied"));
  std::filesystem::create_directory(file("peers"));
  const auto run_copy = [&](const std::string& arguments) { return run("; ./copied " + arguments, "true"); };
  EXPECT_EQ(run_copy("subjects --peers").out, "");
  const Output listed = run_copy("subjects");
  EXPECT_THAT(listed.out, HasSubstr("safeccd                 not built: run tools/subject -o /"));
  EXPECT_THAT(listed.out, HasSubstr("fcl-newton              not built: install libfcl-dev"));
  const Output refused = run_copy("verdict --kind vt --subject additive:iterations=3");
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.error, StartsWith("nearmiss: 'additive' is not built: run tools/subject -o /"));
}

// nearmiss refuses a worker of another build, because nearmiss could misread the answers of such a worker.
TEST_F(CommandLine, AWorkerOfAnotherBuildIsRefused) {
  std::filesystem::copy_file(NEARMISS_EXECUTABLE, file("copied"));
  const auto worker = std::filesystem::path(NEARMISS_EXECUTABLE).parent_path() / "nearmiss-worker";
  std::string code = read(worker);
  write("nearmiss-worker", code);
  const auto executable = std::filesystem::perms::owner_all;
  std::filesystem::permissions(file("nearmiss-worker"), executable);
  const std::string fuzz = "; ./copied fuzz --cases 20 --family uniform --subject wang," + plugin("example");
  EXPECT_EQ(run(fuzz, "true").code, 0);
  const std::string digest = NEARMISS_WORKER_CODE;
  code.replace(code.find(digest), 1, "x");
  write("nearmiss-worker", code);
  const Output refused = run(fuzz, "true");
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.error, HasSubstr("nearmiss-worker does not start one, or is not of the same build as"));
}

TEST_F(CommandLine, ASubcommandForOneSubjectRefusesSeveral) {
  for (const std::string command : {"shrink miss.vt --subject ", "power --time 1s --subject "})
    expect_refused(command + plugin("several"), {"found several detectors, expected one of told, edges"});
}

TEST_F(CommandLine, DetectorsOfAPluginAreDescribed) {
  const Output output = expect_code(0, "subjects " + plugin("several") + " " + plugin("sampling"));
  EXPECT_THAT(output.out, HasSubstr("told                    answers what its option says\n"));
  EXPECT_THAT(output.out, HasSubstr("version 7; vt and ee; 53 bits; no time; batches of 1\n"));
  EXPECT_THAT(output.out, HasSubstr("ee; 53 bits; a lower bound of the time; batches of 1\n"));
  EXPECT_THAT(output.out,
              HasSubstr("batches of 64\n                        presumes: the distance at t = 0 is more than "
                        "9.5367431640625e-07; coordinates are multiples of 0.0009765625; edges and paths are "
                        "at most 2 long\n"));
}

class ReplayOfASubject : public CommandLine {
 protected:
  /// Runs a campaign with a subject that misses collisions. Expects that the command in the first finding
  /// replays the miss. Returns the options of this command.
  [[nodiscard]] std::string options(const std::string& subject) const {
    expect_code(1, "fuzz --family small-integer --cases 100 --db a.db --subject '" + subject + "'");
    const std::string again = report_of("a.db", 1)["findings"][0]["again"];
    expect_code(1, again.substr(9), "cd report &&");
    return again.substr(again.find(" --subject"));
  }
};

TEST_F(ReplayOfASubject, HasTheOptionsOfABuiltInSubject) {
  const std::string subject = "mine=bridson:thickness=0:barycentric=1e-3";
  EXPECT_EQ(options(subject), " --subject " + subject);
}

TEST_F(ReplayOfASubject, HasTheWholePathAndTheOptionsOfAPluginAsTheyWereGiven) {
  const std::string answer = ":told:answer=0/../x";
  std::filesystem::copy(plugin("several"), file("a.so"));
  EXPECT_THAT(options("./a.so" + answer),
              StartsWith(" --subject " + file("a.so").string() + answer + " --query-time"));
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
  EXPECT_THAT(options(subject), StartsWith(" --subject '" + subject + "' --query-time"));
}

TEST_F(CommandLine, APluginMayBeInAnyFolder) {
  const std::string folder = "a\nb";
  std::filesystem::create_directory(file(folder));
  std::filesystem::copy(plugin("never"), file(folder) / "never.so");
  const std::string fuzz = "fuzz --family small-integer --cases 200 --db a.db --subject ./never.so ";
  const std::string there = "cd '" + folder + "' &&";
  for (const std::string& command : {fuzz, fuzz + "--resume", std::string("report a.db -o report")})
    expect_code(1, command, there);
  const std::string again = read_json(folder + "/report/report.json")["findings"][0]["again"];
  EXPECT_THAT(again, HasSubstr(" --subject ./never.so "));  // a full path with a line end is not stored
}

TEST_F(CommandLine, TheLimitsOfAPublishedCcdAreThoseOfItsRun) {
  if (run("subjects --peers").out.find("fcl\n") == std::string::npos) GTEST_SKIP() << "found no libfcl-dev";
  const std::string fuzz =
      "fuzz --subject fcl --cases 100 --no-shrink --db a.db --query-memory 2G --query-time ";
  EXPECT_LE(run(fuzz + "7s").code, 1);
  expect_refused(fuzz + "8s --resume", {"found a run with query-time '7s', expected '8s'"});
  EXPECT_LE(run("report a.db -o report").code, 1);
  const std::string again = read_json("report/report.json")["runs"][0]["again"];
  EXPECT_THAT(again, HasSubstr(" --query-time 7s --query-memory 2147483648"));
}

std::uint64_t count(const nlohmann::json& counts, const std::string& name) { return counts.value(name, 0U); }

TEST_F(CommandLine, QueriesBeyondAContractAreNotAskedOrCountedApart) {
  const std::string fuzz =
      "fuzz --family small-integer --cases 1000 --no-shrink --subject " + plugin("several") + ":narrow-apart";
  const auto alone = json_of(1, fuzz);
  EXPECT_EQ(alone["subjects"].size(), 1U);
  const auto apart = json_of(1, fuzz + " --beyond-contract");
  EXPECT_THAT(read("error.txt"), HasSubstr("narrow-apart (beyond contract)"));
  for (const char* kind : {"vt", "ee"}) {
    const auto& keeping = alone["subjects"]["narrow-apart"][kind];
    EXPECT_EQ(count(keeping, "collisions"), count(apart["subjects"]["narrow-apart"][kind], "collisions"));
    const auto& beyond = apart["subjects"]["narrow-apart (beyond contract)"][kind];
    EXPECT_GT(count(keeping["faults"], "contract"), 0U);
    EXPECT_EQ(count(keeping["faults"], "contract") + count(beyond["faults"], "contract"),
              count(keeping, "queries"));
    // All queries that break this contract have contact at the start, so they are collisions. The plug-in
    // misses all of these collisions.
    EXPECT_EQ(count(beyond, "false_negatives"), count(keeping["faults"], "contract"));
  }
}

// The plug-in misses everything, but its contract requires edges that are at least 1e300 long.
TEST_F(CommandLine, MissesBeyondAContractDoNotCount) {
  const std::string subject = plugin("never_asked");
  EXPECT_EQ(expect_code(0, "family crossed --count 100 --missed-by " + subject).out, "");
  EXPECT_TRUE(json_of(0, "power --way uniform --time 1s --subject " + subject)[0]["failure"].is_null());
}

// Root parity misses collisions with an even number of roots; its contract excludes these collisions.
TEST_F(CommandLine, FailuresBeyondAContractAreShownButNeverCount) {
  const std::string fuzz = "fuzz --family small-integer --cases 2000 --subject parity --beyond-contract";
  expect_code(0, fuzz + " --seed 2 --db before.db");
  const Output asked = expect_code(0, fuzz + " --db a.db");
  EXPECT_THAT(asked.out, HasSubstr(" ok  parity: no miss in "));
  EXPECT_THAT(asked.out, HasSubstr(" --  parity (beyond contract): MISSED "));
  for (const std::string with : {"", " --baseline before.db", " --fail-on unknown,slow"}) {
    const auto report = report_of("a.db" + with);
    EXPECT_TRUE(report["headline"]["clean"]) << with;
    EXPECT_TRUE(report["headline"]["alarms"].empty()) << with;
    const auto& beyond = report["verdicts"][1];
    EXPECT_EQ(beyond["subject"], "parity (beyond contract)");
    EXPECT_TRUE(beyond["beyond_contract"]);
    EXPECT_EQ(beyond["failures"], nlohmann::json{"miss"});
    const std::string replays = report["findings"].at(beyond["finding"].get<std::size_t>())["again"];
    EXPECT_THAT(replays, ::testing::EndsWith(" --subject parity --beyond-contract"));
    ASSERT_THAT(replays, ::testing::StartsWith("nearmiss replay cases/"));
    const Output replayed = run("replay report/" + replays.substr(replays.find("cases/")));
    EXPECT_THAT(replayed.out, HasSubstr("parity (beyond contract): MISSED "));
    EXPECT_FALSE(report["error_against_time"]["subjects"].contains("parity (beyond contract)"));
  }
}

TEST_F(CommandLine, AResumeAsksTheSameSideOfAContract) {
  const std::string fuzz =
      "fuzz --family small-integer --subject " + plugin("several") + ":narrow-apart --db a.db";
  EXPECT_EQ(run(fuzz + " --cases 200").code, 1);
  expect_refused(fuzz + " --cases 200 --resume --beyond-contract", {"beyond contract"});
}

}  // namespace
}  // namespace nearmiss
