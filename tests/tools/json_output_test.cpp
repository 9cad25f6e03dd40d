// --json - writes JSON, and nothing else, to standard output.
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using testing::CommandLine;
using ::testing::HasSubstr;

class JsonToStdout : public CommandLine {
 protected:
  /// Runs a command with --json -, and expects JSON on standard output, the text on stderr, and no file named
  /// "-".
  [[nodiscard]] json json_of(const std::string& arguments, const std::string& text, int code = 0) const {
    const Output output = expect_code(code, arguments + " --json -");
    EXPECT_THAT(output.error, HasSubstr(text)) << arguments;
    EXPECT_FALSE(std::filesystem::exists(file("-"))) << arguments;
    EXPECT_TRUE(json::accept(output.out)) << arguments << ": " << output.out;
    return json::parse(output.out, nullptr, false);
  }
};

TEST_F(JsonToStdout, OfCommandsThatRunTrials) {
  write("q.vt", hit);
  const json replayed = json_of("replay q.vt --subject " + plugin("never"), "MISSED vt 1 of 1;", 1);
  EXPECT_EQ(replayed["subjects"]["always"]["vt"]["false_negatives"], 1);
  EXPECT_EQ(json_of("fuzz --cases 100", "no miss in")["oracle"]["total"]["queries"], 100);
  EXPECT_EQ(
      json_of("ladder --scalar float --family uniform --cases 60", "wang:float")["oracle"]["disagreements"],
      0);
  EXPECT_TRUE(json_of("tightness --time 1ms --tolerance D2", "D2")["tightness"].contains("D2"));
}

TEST_F(JsonToStdout, OfScenes) {
  write_falling_triangle();
  EXPECT_EQ(json_of("scene start.obj end.obj --verify-plan", "plan verified: ")["scenes"].size(), 1);
  EXPECT_EQ(json_of("scene start.obj end.obj --leave-out boxes --thickness 1e9 --subject wang",
                    "contact thickness 1e+09")["scenes"]
                .size(),
            1);
}

TEST_F(JsonToStdout, OfStudies) {
  write("own.vt", hit);
  EXPECT_FALSE(json_of("bench own.vt --queries 5 --runs 1", "ns/query")["results"].empty());
  EXPECT_FALSE(json_of("audit", "TOO SMALL")["constants"].empty());
  EXPECT_EQ(json_of("power --time 1ms --way search --subject defect:mu*1", "found, of 1").size(), 1);
}

TEST_F(JsonToStdout, IsAnErrorIfItCannotBeWritten) {
  write("q.vt", hit);
  const Output output = expect_code(2, "replay q.vt --json -", "", ">/dev/full");
  EXPECT_THAT(output.error,
              HasSubstr("nearmiss: standard output cannot be written: No space left on device\n"));
}

/// "M?", where the second character is a byte that is no UTF-8.
const std::string no_utf8 = "M\xe4";

TEST_F(JsonToStdout, OfFilesWhoseNamesAreNoUtf8) {
  write(no_utf8 + "/q.vt", hit);
  write(no_utf8 + "1.obj", two_triangles("1"));
  write(no_utf8 + "2.obj", two_triangles("-1"));
  std::filesystem::create_directory(file("N\xe4"));
  std::filesystem::copy_file(file(no_utf8 + "/q.vt"), file("N\xe4/q.vt"));
  const std::string quoted = "'" + no_utf8 + "'";
  EXPECT_EQ(json_of("replay " + quoted + " 'N\xe4' --db a.db", "no miss in")["oracle"]["total"]["queries"],
            2);
  EXPECT_THAT(std::string(report_of("a.db")["runs"][0]["again"]), HasSubstr("replay $'M\\344' $'N\\344' "));
  const std::string mesh = " " + quoted + "1.obj " + quoted + "2.obj ";
  EXPECT_EQ(json_of("scene" + mesh + "--db b.db", "scene:M?")["scenes"].size(), 1);
  const std::string fuzz = "fuzz --cases 100 --mesh" + mesh + "--family mesh --db c.db --resume";
  for (int i = 0; i < 2; ++i) EXPECT_EQ(json_of(fuzz, "no miss in")["oracle"]["total"]["queries"], 100);
  EXPECT_EQ(json_of("bench " + quoted + "/q.vt --queries 5 --runs 1 --history h.json", "ns/query").size(), 1);
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
