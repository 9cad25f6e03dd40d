// Tests the command line with bad input. nearmiss must say in one short line what is wrong, and must leave no
// file.
#include <algorithm>
#include <cstdlib>

#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using testing::CommandLine;
using ::testing::HasSubstr;

TEST_F(CommandLine, BadQueries) {
  const std::string numbers = hit.substr(hit.find(' '));
  write("nan.vt", "# a comment\nnan" + numbers);
  write("inf.vt", hit + "inf" + numbers);
  write("word.vt", "x" + numbers);
  write("few.vt", "1 2 3\n");
  write("many.vt", hit.substr(0, hit.size() - 1) + " 5 6\n");
  write("negative.vt", hit.substr(0, hit.size() - 1) + " -5\n");
  write("empty.vt", "");
  write("comments.vt", "# nothing\n");
  for (const std::string command :
       {"oracle --kind vt ", "verdict --kind vt ", "replay --json new.json --db new.db "}) {
    expect_refused(command + "nan.vt", {"nan.vt:2", "'nan'"});
    expect_refused(command + "inf.vt", {"inf.vt:2", "'inf'"});
    expect_refused(command + "word.vt", {"word.vt:1", "'x'"});
    expect_refused(command + "few.vt", {"few.vt:1", "3", "24"});
    expect_refused(command + "many.vt", {"many.vt:1", "24"});
    expect_refused(command + "negative.vt", {"negative.vt:1", "separation -5"});
    expect_refused(command + "empty.vt", {"empty.vt"});
    expect_refused(command + "comments.vt", {"comments.vt:1"});
    expect_refused(command + "absent.vt", {"absent.vt: cannot be read"});
  }
}

TEST_F(CommandLine, FilesThatAreNone) {
  for (const char* command : {"oracle --kind vt", "verdict --kind vt"}) {
    const Output output = run(command, "", "</");  // the input is a folder, which can be opened but not read
    EXPECT_EQ(output.code, 2);
    EXPECT_EQ(output.error, "nearmiss: stdin: cannot be read to its end\n");
  }
  for (const char* make : {"mkdir x.vt x.obj x.db", "mkfifo x.vt x.obj x.db"}) {
    ASSERT_EQ(std::system(("cd " + file("").string() + " && rm -rf x.* && " + make).c_str()), 0);
    const std::string found = std::string(make).starts_with("mkdir") ? "found a folder" : "found a pipe";
    if (found == "found a pipe")
      expect_refused("replay x.vt --db new.db", {"x.vt: " + found, "expected a file"});
    expect_refused("scene x.obj x.obj --db new.db", {"x.obj: " + found});
    expect_refused("fuzz --cases 10 --mesh x.obj x.obj --db new.db", {"x.obj: " + found});
    expect_refused("report x.db -o new", {"x.db: " + found});
    expect_refused("merge new.db x.db --salvage", {"x.db: " + found});
    expect_refused("bench --history x.db", {"x.db: " + found});
    expect_refused("power --json x.db", {"x.db: " + found});
  }
}

TEST_F(CommandLine, AWrongNumberOfLanes) {
  for (const char* wrong : {"3", "16", "x", "-2", "8 "}) {
    const Output output =
        expect_code(2, "oracle --kind vt hit.vt", std::string("NEARMISS_LANES='") + wrong + "'");
    EXPECT_EQ(output.error,
              "nearmiss: NEARMISS_LANES: found '" + std::string(wrong) + "', expected 2, 4 or 8\n");
  }
  for (const std::string right : {"", "2"})
    expect_code(0, "oracle --kind vt hit.vt", "NEARMISS_LANES=" + right);
}

TEST_F(CommandLine, ArgumentsWithoutAValue) {
  expect_refused("fuzz --time ''", {"found an empty argument after '--time', expected a value"});
  expect_refused("fuzz --cases 10 --subject ,", {"found an empty list after '--subject', expected a value"});
  expect_refused("fuzz --cases 10 --db=", {"found '--db=', expected a value"});
  expect_refused("fuzz --cases 10 --json ''", {"after '--json'"});
  for (const std::string size : {"-1", "99999999999999999999G", "18014398509481984K", "1X", "1Gi", "iB", ""})
    expect_refused("verdict --kind vt --query-memory '" + size + "'",
                   {size.empty() ? "--query-memory" : "--query-memory: found '" + size + "'"});
  expect_refused("power --time nan --json new.json", {"--time: found 'nan'"});
  EXPECT_EQ(run("fuzz --cases 100 --db a.db").code, 0);
  expect_refused("report a.db -o ''", {"after '-o'"});
  expect_refused("fuzz --cases 10 --db new.db --json ./new.db", {"found the same file for --json and --db"});
}

TEST_F(CommandLine, BadShrinks) {
  write("two.vt", hit + miss);
  write("nan.vt", "nan" + hit.substr(hit.find(' ')));
  const std::string never = " --subject " + plugin("never");
  expect_refused("shrink hit.vt -o new", {"hit.vt:1", "wang does not fail", "expected a missed collision"});
  expect_refused("shrink two.vt -o new" + never, {"two.vt: found 2 queries, expected one"});
  expect_refused("shrink nan.vt -o new" + never, {"nan.vt:1", "'nan'"});
  expect_refused("shrink absent.case -o new" + never, {"absent.case: cannot be read"});
  expect_refused("shrink hit.vt -o new --subject wong", {"unknown subject 'wong'"});
  expect_refused("verdict --kind vt hit.vt --subject " + plugin("error"), {"always: no answer: vt error -7"});
  expect_refused("shrink hit.vt -o no/folder/new.case" + never, {"no/folder/new.case: cannot be written"});
  expect_refused("shrink", {"CASE"});
}

TEST_F(CommandLine, BadNames) {
  expect_refused("replay hit.vt --subject wong --db new.db", {"unknown subject 'wong'", "wang", "exact"});
  expect_refused("replay hit.vt --subject wang,wang --db new.db", {"two subjects named 'wang'"});
  expect_refused("fuzz --cases 10 --family plantet --db new.db", {"unknown family 'plantet'", "planted"});
  expect_refused("fuzz --cases 10 --family planted,all --db new.db", {"the family 'planted' twice"});
  expect_refused("fuzz --cases 10 --family aspect@17 --db new.db", {"'aspect@17'", "from 0 to 16"});
  expect_refused("fuzz --cases 10 --family mesh --db new.db", {"unknown family 'mesh'"});
  expect_refused("fuzz --cases 10 --sweep aspekt --db new.db", {"unknown family 'aspekt'", "aspect"});
  expect_refused("fuzz --cases 10 --sweep uniform --db new.db", {"'uniform'", "with a parameter"});
  expect_refused("fuzz --cases 10 --sweep aspect,aspect --db new.db", {"'aspect@0' twice in --sweep"});
  expect_refused("verdict --kind vt --subject wong hit.vt", {"unknown subject 'wong'"});
  expect_refused("oracle --kind vf hit.vt", {"--kind", "vf"});
  expect_refused("oracle --kind vt hit.vt --method sturm", {"'sturm' is gone", "--method certificate"});
  expect_refused("verdict --kind vt --bound 0.5 hit.vt",
                 {"the given bound B = 0.5", "is smaller than a pair's own"});
  expect_refused("verdict --kind vt --bound=-1 hit.vt", {"--bound: found '-1', expected a positive number"});
}

TEST_F(CommandLine, BadUsage) {
  expect_refused("", {"subcommand"});
  expect_refused("fuzz --db new.db", {"--cases", "--time"});
  expect_refused("fuzz --cases 0 --db new.db", {"--cases"});
  expect_refused("fuzz --cases 10 --sweep aspect --steps 1 --db new.db", {"--steps"});
  expect_refused("fuzz --cases 10 --steps 3 --db new.db", {"--steps", "--sweep"});
  expect_refused("fuzz --cases 10 --sweep aspect --family aspect --db new.db", {"--sweep", "--family"});
  expect_refused("fuzz --cases 10 --mesh a.obj --db new.db", {"a.obj", "neither a folder nor a scene"});
  expect_refused("fuzz --time 3parsec --db new.db", {"--time: found '3parsec'", "30s"});
  expect_refused("fuzz --cases 10 --shard 2/2 --db new.db", {"--shard: found '2/2'"});
  expect_refused("fuzz --cases 10 --shard 0/18446744073709551615",
                 {"--shard: found '0/18446744073709551615', expected I/N with 0 <= I < N <= 1000000"});
  expect_refused("replay hit.vt --json no/folder/new.json", {"no/folder"});
  expect_refused("replay hit.vt --db no/folder/new.db", {"no/folder/new.db"});
  expect_refused("replay", {"PATH"});
}

TEST_F(CommandLine, BadPlugins) {
  for (const auto& [name, words] : std::vector<std::pair<std::string, std::vector<std::string>>>{
           {"no_function", {"no_function.so", "nearmiss_get_subject"}},
           {"version_1", {"version_1.so", "found version 1 of the plug-in interface", "expected 2"}},
           {"absent", {"absent.so", "cannot load"}}})
    expect_refused("replay hit.vt --db new.db --json new.json --subject " + plugin(name), words);
}

TEST_F(CommandLine, BadMeshes) {
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  write("good.obj", square + "f 1 2 3\n");
  write("other.obj", square + "f 1 2 4\n");
  write("five.obj", square + "v 0 0 0\nf 1 2 3\n");
  write("far.obj", square + "f 1 2 9\n");
  write("nan.obj", "v 0 nan 0\n" + square + "f 1 2 3\n");
  write("empty.obj", "");
  const auto refused = [&](const std::string& end, const std::vector<std::string>& words) {
    expect_refused("scene good.obj " + end + " --db new.db --json new.json", words);
  };
  refused("other.obj", {"other.obj", "1 2 4", "1 2 3"});
  refused("five.obj", {"five.obj", "5 vertices", "4"});
  refused("far.obj", {"far.obj:5", "vertex 9"});
  refused("nan.obj", {"nan.obj:1", "'nan'"});
  refused("empty.obj", {"empty.obj"});
  refused("absent.obj", {"absent.obj: cannot be read"});
  expect_refused("fuzz --cases 10 --mesh good.obj five.obj --db new.db", {"five.obj", "5 vertices"});
  write("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  expect_refused("fuzz --cases 10 --mesh one.obj one.obj --db new.db", {"no pair in the mesh"});
}

TEST_F(CommandLine, BadStores) {
  write("text.db", "no database, but long enough to look like one if nobody looks at it closely");
  write("taken.db", "precious");
  expect_refused("report text.db -o new", {"text.db", "not a database"});
  expect_refused("report absent.db -o new", {"absent.db: no such file"});
  EXPECT_EQ(run("fuzz --cases 10 --db good.db").code, 0);
  expect_refused("report good.db -o new --power text.db",
                 {"text.db", "expected what nearmiss power --json keeps"});
  expect_refused("report good.db -o new --environments text.db",
                 {"text.db", "expected the table of tools/environments"});
  expect_refused("report good.db -o new --baseline text.db", {"text.db", "not a database"});
  expect_refused("merge new.db absent.db", {"absent.db: no such file"});
  expect_refused("fuzz --cases 10 --db taken.db", {"taken.db: exists already"});
  EXPECT_EQ(read("taken.db"), "precious");
}

class Messages : public CommandLine {
 protected:
  /// Expects that nearmiss refuses a command in a short line that contains `words`.
  void expect_short(const std::string& arguments, const std::string& words) const {
    expect_refused(arguments, {words});
    EXPECT_LT(read("error.txt").size(), 1200) << arguments;
  }
};

TEST_F(Messages, ALongWordOfAFileIsCut) {
  const std::string word(1'000'000, 'x');  // a line of a file may have up to 1 MiB
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
  for (int i = 0; i < 30; ++i) word += "\xc3\xa9";  // byte 41 of the word is the second byte of a character
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
    expect_short(command + word + (command == "replay --bound " ? " hit.vt" : ""), "x...");
}

TEST_F(Messages, ANameDoesNotWriteToTheTerminal) {
  const std::string odd = "'a\x1b[31mb\nc'";
  expect_refused("fuzz --cases 10 --subject " + odd, {"a?[31mb c"});
  expect_refused("report " + odd + " -o new", {"a?[31mb c: no such file"});
}

TEST_F(Messages, ANanIsCalledOne) {
  expect_refused("replay hit.vt --bound nan", {"--bound: found 'nan', expected a finite number"});
  expect_refused("scene flying@100 --bound pair,nan", {"--bound: found 'nan'"});
  expect_refused("scene flying@100 --thickness nan", {"--thickness: found 'nan'"});
  for (const char* bound : {"nan", "inf", "-1", "0", "1e999"})
    for (const char* name : {"wang", "wang:float", "basic"})
      expect_refused(std::string("replay hit.vt --subject ") + name + "@" + bound,
                     {std::string("'") + name + "@" + bound + "': found the bound '" + bound +
                      "', expected a positive finite number"});
  for (const std::string width : {"nan", "-1", "1e999", "x"})
    expect_refused("oracle --kind vt --width " + width + " hit.vt",
                   {"--width: found '" + width + "', expected a number from 0 to 1"});
  const auto bound_of = [&](const std::string& name, const std::string& words) {
    expect_refused("verdict --kind vt --distance-bound miss.vt --subject " + plugin(name), {words});
  };
  bound_of("bound_nan", "always: found the distance bound NaN, expected 0 or more");
  bound_of("bound_negative", "always: found the distance bound -1, expected 0 or more");
  bound_of("bound_abort", "always: no distance bound: vt crash ABRT");
}

TEST_F(Messages, AStoreThatExistsNamesResumeWhereThereIsOne) {
  const std::string fuzz = "fuzz --cases 4 --db a.db";
  expect_code(0, fuzz);
  expect_refused(fuzz,
                 {"a.db: exists already, expected a new file, or --resume to continue the campaign in it"});
  expect_refused("replay hit.vt --db a.db", {"a.db: exists already, expected a new file\n"});
}

}  // namespace
}  // namespace nearmiss
