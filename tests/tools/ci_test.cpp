// Results for systems of continuous integration, and campaigns that a file describes.
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using testing::Background;
using testing::CommandLine;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class Ci : public CommandLine {
 protected:
  const std::string campaign = "fuzz --subject basic,wang --family uniform,planted --cases 2000 ";
};

TEST_F(Ci, JUnitHasATestForEachSubjectKindAndClass) {
  expect_code(1, campaign + "--junit new.xml --db a.db");
  const std::string xml = read("new.xml");
  EXPECT_THAT(xml, StartsWith("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites"));
  EXPECT_THAT(xml, HasSubstr("<testsuite name=\"wang\" tests=\"4\" failures=\"0\""));
  EXPECT_THAT(xml, HasSubstr("<testcase classname=\"nearmiss.wang\" name=\"vt, ordinary families\"/>"));
  EXPECT_THAT(xml, HasSubstr("<testsuite name=\"basic\" tests=\"4\" failures=\"2\""));
  EXPECT_THAT(xml, HasSubstr("<failure message=\"missed "));
  EXPECT_THAT(xml, HasSubstr("again: nearmiss fuzz --subject basic,wang"));
  // The query in the failure is one that the subject misses.
  const std::size_t line = xml.find("; vt query:\n") + 12;
  write("q.vt", xml.substr(line, xml.find('\n', line) - line) + "\n");
  EXPECT_EQ(run("replay q.vt --subject basic").code, 1);
  EXPECT_EQ(run("replay q.vt --subject wang").code, 0);
  // A report writes the same.
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
        "# our trial\nsubject = [\"basic\", \"wang\"]\nfamily = [\"uniform\", \"planted\"]\ncases = 2000\n");
  expect_code(1, campaign + "--json a.json");
  expect_code(1, "fuzz --config trial.toml --json b.json");
  const auto results = [&](const std::string& name) {
    auto all = read_json(name)["subjects"];
    for (auto& subject : all)
      for (auto& kind : subject) kind = kind["families"]["planted"]["false_negatives"];
    return all.dump();
  };
  EXPECT_EQ(results("a.json"), results("b.json"));
  // The command line counts more than the file.
  expect_code(0, "fuzz --config trial.toml --subject wang --json c.json");
  EXPECT_EQ(read_json("c.json")["subjects"].size(), 1);
  expect_refused("fuzz --config nowhere.toml", {"nowhere.toml"});
  write("bad.toml", "subjects = \"wang\"\ncases = 10\n");
  expect_refused("fuzz --config bad.toml", {"subjects"});
  // Everything that a list and a number may have in TOML.
  write("odd.toml",
        "\xEF\xBB\xBFsubject = [  # \"never\", [\n  \"basic\" ,\n\n  'wang',  # ]\n]  # two\r\n"
        "family = [ \"uniform\", \"planted\", ]\ncases = 2_000\n");
  expect_code(1, "fuzz --config odd.toml --json d.json");
  EXPECT_EQ(results("d.json"), results("a.json"));
  // Within quotes, '#' and brackets are letters.
  write("a#[b.vt", hit);
  write("near.toml", "subject = \"wang\"\nnear = \"a#[b.vt\"\nfamily = [\"near\"]\ncases = 10\n");
  expect_code(0, "fuzz --config near.toml --json e.json");
  EXPECT_EQ(read_json("e.json")["subjects"]["wang"]["vt"]["families"]["near"]["queries"], 10);
  write("open.toml", "cases = 10\nsubject = [\n  \"wang\",\n");
  expect_refused("fuzz --config open.toml", {"--config:2: found '[' without ']'"});
}

}  // namespace
}  // namespace nearmiss
