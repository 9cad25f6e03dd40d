// nearmiss subjects.
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using testing::CommandLine;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::StartsWith;

TEST_F(CommandLine, SubjectsAreListed) {
  const Output output = run("subjects");
  for (const char* name :
       {"basic ", "basic-plain ", "wang ", "wang-eps ", "wang-plain ", "exact ", "bridson ", "defect:vv "})
    EXPECT_THAT(output.out, HasSubstr(name));
}

TEST_F(CommandLine, OnlyPluginsAndPublishedCcdsAreDescribed) {
  expect_refused("subjects wang", {"found 'wang', expected a plug-in", "or a published CCD"});
  EXPECT_THAT(run("subjects fcl-newton").out, HasSubstr("vt and ee; 53 bits; an estimate of the time"));
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

TEST_F(CommandLine, PublishedCcdsAreListedWithWhatTheyAre) {
  const Output output = run("subjects");
  EXPECT_THAT(
      output.out,
      HasSubstr("fcl                     FCL's CCD of deformable meshes, with its solver for cubics\n"));
  EXPECT_THAT(output.out,
              HasSubstr("bullet                  the CCD of Bullet's soft bodies, in single precision"));
  EXPECT_THAT(run("subjects --peers").out, StartsWith("fcl\nfcl-newton\nbullet\nbullet-double\n"));
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

// If a program found the worker of another build, it would misread the worker's answers.
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
  const std::string miss_of_always = write("a.vt", miss).string();
  for (const std::string& command :
       {"shrink " + miss_of_always + " --subject ", std::string("power --time 1s --subject ")})
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

}  // namespace
}  // namespace nearmiss
