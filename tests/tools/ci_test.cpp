// Tests the results that nearmiss writes for other programs, such as systems of continuous integration. Also
// tests the options --watch and --config of campaigns.
#include <chrono>
#include <cstdlib>
#include <thread>

#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using testing::Background;
using testing::CommandLine;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class Ci : public CommandLine {
 protected:
  const std::string campaign = "fuzz --subject basic,wang --family uniform,planted --cases 1000 ";
};

TEST_F(Ci, JUnitHasATestForEachSubjectKindAndClass) {
  expect_code(1, campaign + "--junit new.xml --db a.db");
  const std::string xml = read("new.xml");
  EXPECT_THAT(xml, StartsWith("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites"));
  EXPECT_THAT(xml, HasSubstr("<testsuite name=\"wang\" tests=\"4\" failures=\"0\""));
  EXPECT_THAT(xml, HasSubstr("<testcase classname=\"nearmiss.wang\" name=\"vt, ordinary families\"/>"));
  EXPECT_THAT(xml, HasSubstr("<testsuite name=\"basic\" tests=\"4\" failures=\"1\""));
  EXPECT_THAT(xml, HasSubstr("<failure message=\"missed "));
  EXPECT_THAT(xml, HasSubstr("again: nearmiss fuzz --subject basic,wang"));
  const std::size_t line = xml.find("; vt query:\n") + 12;
  write("q.vt", xml.substr(line, xml.find('\n', line) - line) + "\n");
  expect_code(1, "replay q.vt --no-shrink --subject basic");
  expect_code(0, "replay q.vt --subject wang");
  expect_code(1, "report a.db -o report --junit report.xml");
  EXPECT_EQ(read("report.xml"), xml);
  EXPECT_EQ(std::system(("python3 -c 'import sys, xml.dom.minidom; xml.dom.minidom.parse(sys.argv[1])' " +
                         file("new.xml").string())
                            .c_str()),
            0);
}

TEST_F(Ci, JUnitIsRefusedWhereItCannotBeWritten) {
  expect_refused("fuzz --subject wang --cases 10 --junit nowhere/new.xml --db new.db", {"nowhere"});
  expect_refused("fuzz --subject wang --cases 10 --junit new.db --db new.db", {"--junit", "--db"});
  expect_refused("fuzz --subject wang --cases 10 --junit ./new.json --json new.json", {"--junit", "--json"});
  expect_refused("fuzz --subject wang --cases 10 --junit -", {"--junit: found '-', expected a file"});
  expect_code(0, "fuzz --subject wang --cases 10 --junit a.xml --json - --db a.db");
  expect_refused("report a.db -o new --junit a.db", {"--junit", "DB"});
  expect_refused("report a.db -o . --junit report.json", {"--junit", "-o"});
  expect_refused("report a.db -o new --junit -", {"--junit: found '-', expected a file"});
  EXPECT_FALSE(std::filesystem::exists(file("-")));
}

TEST_F(Ci, GitHubGetsAnAnnotationForEachFailure) {
  const Output output = expect_code(1, campaign + "--github");
  EXPECT_THAT(output.out, HasSubstr("::error title=nearmiss%3A basic::missed "));
  EXPECT_THAT(output.out, HasSubstr(" query: "));
  EXPECT_THAT(output.out, Not(HasSubstr("title=nearmiss%3A wang")));
}

TEST_F(Ci, ACampaignRunsAgainWhenThePluginIsCompiled) {
  std::filesystem::copy_file(plugin("never"), file("mine.so"));
  Background watching(file(""), "fuzz --subject ./mine.so --family uniform --cases 200 --quiet --watch");
  const auto wait_for = [&](const std::string& words) {
    EXPECT_TRUE(watching.wait_until([&] { return read("out.txt").find(words) != std::string::npos; }))
        << read("error.txt");
  };
  wait_for("FAIL always: MISSED");
  std::filesystem::remove(file("mine.so"));
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  std::filesystem::copy_file(plugin("always"), file("mine.so"));
  wait_for(" ok  always: no miss");
  EXPECT_THAT(read("error.txt"), HasSubstr("watching ./mine.so"));
  watching.stop(SIGINT);
  expect_refused("fuzz --subject wang --cases 10 --watch", {"--watch", "wang"});
}

TEST_F(Ci, AFileDescribesACampaign) {
  write("trial.toml",
        "# our trial\nsubject = [\"basic\", \"wang\"]\nfamily = [\"uniform\", \"planted\"]\ncases = 1000\n");
  const auto results = [&](const std::string& command) {
    auto all = json_of(1, command + " --no-shrink")["subjects"];
    for (auto& subject : all)
      for (auto& kind : subject) kind = kind["families"]["planted"]["false_negatives"];
    return all;
  };
  const auto expected = results(campaign);
  EXPECT_EQ(results("fuzz --config trial.toml"), expected);
  // An option on the command line overrides the configuration file.
  EXPECT_EQ(json_of(0, "fuzz --config trial.toml --subject wang")["subjects"].size(), 1);
  expect_refused("fuzz --config nowhere.toml", {"nowhere.toml"});
  write("bad.toml", "subjects = \"wang\"\ncases = 10\n");
  expect_refused("fuzz --config bad.toml",
                 {"bad.toml:1: found the option '--subjects', expected one such as '--subject'"});
  for (const auto& [text, words] : std::vector<std::pair<std::string, std::string>>{
           {"# a comment\n\nseed = 1\ncases = 1e",
            "wrong.toml:4: --cases: found '1e', expected a whole number"},
           {"subject = [\n  'wang',\n]\nkind = \"vx\"\ncases = 9\n",
            "wrong.toml:4: --kind: found 'vx', expected one of vt,ee,vv,ve"},
           {"cases = 9\nfuzz.time = \"soon\"\n", "wrong.toml:2: --time: found 'soon', expected"},
           {"cases = 9\nquickly\n", "wrong.toml:2: found the option '--quickly', expected one such as"}}) {
    write("wrong.toml", text);
    expect_refused("fuzz --config wrong.toml", {words});
  }
  // In TOML, a list may contain comments and line ends, and a comma may follow its last element. A number may
  // contain _.
  write("odd.toml",
        "\xEF\xBB\xBFsubject = [  # \"never\", [\n  \"basic\" ,\n\n  'wang',  # ]\n]  # two\r\n"
        "family = [ \"uniform\", \"planted\", ]\ncases = 1_000\n");
  EXPECT_EQ(results("fuzz --config odd.toml"), expected);
  // Within quotes, '#' and brackets are ordinary characters.
  write("a#[b.vt", hit);
  write("near.toml", "subject = \"wang\"\nnear = \"a#[b.vt\"\nfamily = [\"near\"]\ncases = 10\n");
  const auto near = json_of(0, "fuzz --config near.toml")["subjects"]["wang"]["vt"]["families"]["near"];
  EXPECT_EQ(near["queries"], 10);
  write("open.toml", "cases = 10\nsubject = [\n  \"wang\",\n");
  expect_refused("fuzz --config open.toml", {"nearmiss: open.toml:2: found '[' without ']', expected both"});
}

class JsonToStdout : public CommandLine {};

TEST_F(JsonToStdout, IsAnErrorIfItCannotBeWritten) {
  EXPECT_THAT(expect_code(2, "replay hit.vt --json -", "", ">/dev/full").error,
              HasSubstr("nearmiss: standard output cannot be written: No space left on device\n"));
}

/// A name that is not UTF-8. Messages show it as "M?".
const std::string no_utf8 = "M\xe4";

TEST_F(JsonToStdout, OfFilesWhoseNamesAreNoUtf8) {
  for (const std::string& folder : {no_utf8, std::string("N\xe4")}) write(folder + "/q.vt", hit);
  write(no_utf8 + "1.obj", two_triangles("1"));
  write(no_utf8 + "2.obj", two_triangles("-1"));
  const std::string quoted = "'" + no_utf8 + "'";
  const auto asked = [](const json& results) { return results["oracle"]["total"]["queries"]; };
  EXPECT_EQ(asked(json_of(0, "replay " + quoted + " 'N\xe4' --db a.db")), 2);
  EXPECT_THAT(std::string(report_of("a.db")["runs"][0]["again"]), HasSubstr("replay $'M\\344' $'N\\344' "));
  const std::string mesh = " " + quoted + "1.obj " + quoted + "2.obj ";
  EXPECT_EQ(json_of(1, "scene" + mesh + "-v")["scenes"].size(), 1);
  EXPECT_THAT(read("error.txt"), HasSubstr("scene:M?"));
  const std::string fuzz = "fuzz --cases 100 --mesh" + mesh + "--family mesh --db c.db --resume";
  for (int i = 0; i < 2; ++i) EXPECT_EQ(asked(json_of(0, fuzz)), 100);
  EXPECT_EQ(json_of(0, "bench " + quoted + "/q.vt --queries 5 --runs 1 --history h.json").size(), 1);
  EXPECT_FALSE(std::filesystem::exists(file("-")));
}

TEST_F(JsonToStdout, APluginWhoseNameIsNoUtf8IsRefused) {
  std::filesystem::copy_file(plugin("example"), file(no_utf8 + ".so"));
  for (const std::string command : {"fuzz --cases 100 --db new.db", "bench --json new.json"})
    expect_refused(command + " --subject './" + no_utf8 + ".so'",
                   {"--subject: found './M?.so', expected a path in UTF-8"});
  expect_refused("subjects --targets wang './p\nlate x/p.so'",
                 {"--subject: found './p late x/p.so', expected"});
}

}  // namespace
}  // namespace nearmiss
