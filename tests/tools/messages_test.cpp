// Error messages are one helpful line: long words are cut, a NaN is called NaN, and --resume is suggested.
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using testing::CommandLine;
using ::testing::HasSubstr;

class Messages : public CommandLine {
 protected:
  /// Expects that a command is refused with these words, in a short line.
  void expect_short(const std::string& arguments, const std::string& words) const {
    expect_refused(arguments, {words});
    EXPECT_LT(read("error.txt").size(), 1200) << arguments;
  }
};

TEST_F(Messages, ALongWordOfAFileIsCut) {
  const std::string word(1'000'000, 'x');  // a line may have 1 MiB
  const std::string forty(40, 'x');
  const std::string cut = "'" + forty + "...'";
  write("q.vt", word);
  write("a.case", "kind " + word);
  write("b.case", "truth " + word);
  write("c.case", word + " 1");
  write("edge-edge/a.csv", word + ",1,1,1,1,1,0");
  write("edge-edge/b.csv", "1,1,1,1,1,1," + word);
  for (const char* ending : {".obj", ".off", ".ply"}) write("mesh" + std::string(ending), word);
  write("mesh.stl", "solid\n" + word);
  write("power.json", "[\"" + word);
  EXPECT_EQ(run("fuzz --cases 4 --db a.db").code, 0);
  for (const char* file : {"q.vt", "a.case", "b.case", "c.case", "edge-edge/b.csv"})
    expect_short("replay " + std::string(file), cut);
  expect_short("replay edge-edge/a.csv", "'" + forty + "...,1'");
  for (const char* ending : {".obj", ".off", ".ply", ".stl"})
    expect_short("scene mesh" + std::string(ending) + " mesh" + ending, cut);
  expect_short("report a.db -o new --power power.json", "..., expected what nearmiss power --json keeps");
}

TEST_F(Messages, AWordIsCutBetweenCharacters) {
  std::string word = "x";
  for (int i = 0; i < 30; ++i) word += "\xc3\xa9";  // byte 41 is the second byte of a character
  write("q.vt", word);
  expect_short("replay q.vt", std::string("'").append(word, 0, 39).append("...'"));
}

TEST_F(Messages, ALongWordOfTheCommandLineIsCut) {
  const std::string word(100'000, 'x');
  for (const std::string command :
       {"", "subjects ", "fuzz --cases ", "fuzz --time ", "fuzz --cases 1 --shard ",
        "fuzz --cases 1 --family ", "fuzz --cases 1 --family aspect@", "fuzz --cases 1 --subject ",
        "fuzz --cases 1 --subject wang:", "fuzz --cases 1 --subject defect:", "tightness --tolerance ",
        "oracle --kind ", "replay --bound "})
    expect_short(command + word + (command == "replay --bound " ? " q.vt" : ""), "x...");
}

TEST_F(Messages, ANameDoesNotWriteToTheTerminal) {
  const std::string odd = "'a\x1b[31mb\nc'";
  expect_refused("fuzz --cases 10 --subject " + odd, {"a?[31mb c"});
  expect_refused("report " + odd + " -o new", {"a?[31mb c: no such file"});
}

TEST_F(Messages, ANanIsCalledOne) {
  write("q.vt", hit);
  expect_refused("replay q.vt --bound nan", {"--bound: found 'nan', expected a finite number"});
  expect_refused("scene flying@100 --bound pair,nan", {"--bound: found 'nan'"});
  expect_refused("scene flying@100 --thickness nan", {"--thickness: found 'nan'"});
  for (const char* bound : {"nan", "inf", "-1", "0", "1e999"})
    for (const char* name : {"wang", "wang:float", "basic"})
      expect_refused(std::string("replay q.vt --subject ") + name + "@" + bound,
                     {std::string("'") + name + "@" + bound + "': found the bound '" + bound +
                      "', expected a positive finite number"});
  for (const std::string width : {"nan", "-1", "1e999", "x"})
    expect_refused("oracle --kind vt --width " + width + " q.vt",
                   {"--width: found '" + width + "', expected a number from 0 to 1"});
  write("miss.vt", miss);
  const auto bound_of = [&](const std::string& name, const std::string& words) {
    expect_refused("verdict --kind vt --distance-bound miss.vt --subject " + plugin(name), {words});
  };
  bound_of("bound_nan", "always: found the distance bound NaN, expected 0 or more");
  bound_of("bound_negative", "always: found the distance bound -1, expected 0 or more");
  bound_of("bound_abort", "always: no distance bound: vt crash ABRT");
}

TEST_F(Messages, AStoreThatExistsNamesResumeWhereThereIsOne) {
  write("q.vt", hit);
  const std::string fuzz = "fuzz --cases 4 --db a.db";
  EXPECT_EQ(run(fuzz).code, 0);
  expect_refused(fuzz,
                 {"a.db: exists already, expected a new file, or --resume to continue the campaign in it"});
  EXPECT_EQ(run(fuzz + " --resume").code, 0);
  expect_refused("replay q.vt --db a.db", {"a.db: exists already, expected a new file\n"});
}

TEST_F(Messages, OptionsTakeTheirValueBehindAnEqualsSignToo) {
  write("q.vt", miss);
  write_falling_triangle();
  const std::vector<std::string> commands{
      // NOLINTNEXTLINE(bugprone-suspicious-missing-comma): one command in several literals
      "fuzz --cases=40 --family=uniform,planted --seed=2 --shard=0/1 --subject=wang,basic --jobs=1 "
      "--compare=1 "
      "--query-time=1s --query-memory=1G --time=1m --json=a.json --db=a.db",
      "fuzz --cases=40 --sweep=aspect --steps=2",
      "fuzz --cases=40 --family=mesh --mesh=start.obj end.obj",
      "replay q.vt --subject=wang --bound=8 --compare=1 --db=b.db",
      "scene start.obj end.obj --subject=wang --bound=pair,100 --leave-out=boxes --export=pairs "
      "--json=s.json",
      "report a.db --output=report --baseline=b.db",
      "ladder --cases=8 --scalar=float --family=uniform --seed=3",
      "tightness --time=1ms --tolerance=D2 --seed=3",
      "power --time=1ms --way=families --subject=defect:mu*1 --seed=1 --json=power.json --jobs=1",
      "audit --json=audit.json",
      "bench --subject=basic --queries=5 --runs=1 --json=bench.json",
      "family uniform --kind=vt --count=2 --first=1 --seed=1",
      "oracle --kind=vt --method=all --width=0.5 --toi q.vt",
      "verdict --kind=vt --subject=wang --bound=8 q.vt"};
  for (const std::string& command : commands) {
    const Output output = run(command);
    EXPECT_LE(output.code, 1) << command << ": " << output.error;
    EXPECT_THAT(output.error, ::testing::Not(HasSubstr("nearmiss: "))) << command;
  }
  EXPECT_EQ(read_json("a.json")["runs"][0]["subjects"], "wang,basic");
  EXPECT_TRUE(std::filesystem::exists(file("report/index.html")));
}

}  // namespace
}  // namespace nearmiss
