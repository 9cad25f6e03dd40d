// Detectors that are programs (fuzz/subjects/PROGRAMS.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "ccd/error.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "tests/fuzz/family_queries.hpp"
#include "tests/temporary_folder.hpp"

namespace nearmiss {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class ProgramTest : public testing::TemporaryFolder {
 protected:
  /// A program that describes itself, and does `then` with the `rows` of each request before it reports all its queries.
  [[nodiscard]] std::string program(const std::string& then, const std::string& lines = "") const {
    return command("say('nearmiss 2\\nname p\\nkinds vt ee\\nbatch 64\\n" + lines + R"(\n')
while header := sys.stdin.buffer.read(24):
    question, kind, n = map(int, struct.unpack('<3d', header))
    rows = [struct.unpack('<25d', sys.stdin.buffer.read(200)) for i in range(n)]
    answers = [1, 0.5] * n
    )" + then + R"(
    sys.stdout.buffer.write(struct.pack(f'<{len(answers)}d', *answers))
    sys.stdout.buffer.flush()
)");
  }

  /// A program in Python.
  [[nodiscard]] std::string command(const std::string& code) const {
    const std::string text =
        "import atexit, os, signal, struct, subprocess, sys, time\n"
        "def say(text):\n    sys.stdout.write(text)\n    sys.stdout.flush()\n" +
        code;
    return "pipe:" NEARMISS_PYTHON " " + write("p.py", text).string();
  }

  /// The digest of a program with this code, in a file whose name has a blank.
  [[nodiscard]] std::string digest(const std::string& code) const {
    const std::string file = command(code).substr(std::string("pipe:" NEARMISS_PYTHON " ").size());
    std::filesystem::rename(file, file + " p.py");
    return plugin_identity(*make_any_subject("pipe:" NEARMISS_PYTHON " '" + file + " p.py'"))->sha256;
  }

  /// The verdict about the last of three queries.
  [[nodiscard]] static Verdict last_verdict(const std::string& name, std::string* text = nullptr) {
    const auto subject = make_any_subject(name, std::nullopt, {.time = std::chrono::milliseconds(200)});
    std::vector<Query> queries(3);
    queries.back().x[0] = 1;
    std::vector<Verdict> verdicts(queries.size());
    subject->decide(queries, verdicts);
    EXPECT_EQ(verdicts[0].fault, Fault::none);
    EXPECT_EQ(verdicts[1].fault, Fault::none);
    if (text != nullptr) *text = subject->fault_text(verdicts.back());
    return verdicts.back();
  }
};

TEST_F(ProgramTest, TheExampleAnswersAsTheSharedObjectDoes) {
  const auto program = make_any_subject("pipe:" NEARMISS_PYTHON " " NEARMISS_EXAMPLES "/example.py");
  const auto object = make_any_subject(NEARMISS_PLUGINS "/example.so");
  EXPECT_EQ(program->name(), "boxes-numpy");
  const auto queries = testing::first_queries("planted", 3000);
  std::vector<Verdict> of_program(queries.size());
  std::vector<Verdict> of_object(queries.size());
  EXPECT_EQ(program->decide_timed(queries, of_program).queries, queries.size());
  object->decide(queries, of_object);
  for (std::size_t i = 0; i < queries.size(); ++i) EXPECT_EQ(of_program[i].hit, of_object[i].hit) << i;
}

TEST_F(ProgramTest, SaysWhatASharedObjectCan) {
  const auto subject =
      make_any_subject(program("if question == 1: answers = [0.125 * kind, 0] * n",
                               "version 3\\nabout a test\\nbits 24\\ntime estimate\\nseparation yes\\nbound "
                               "yes\\napart-at-start yes\\napart-by 0.125\\none-root yes\\n"
                               "grid 0.25\\nshortest 0.5\\nlongest 8\\n"));
  const DetectorInfo& info = *plugin_info(*subject);
  EXPECT_EQ(info.version, "3");
  EXPECT_EQ(info.about, "a test");
  EXPECT_TRUE(info.is_narrow);
  EXPECT_EQ(info.time_sort, TimeSort::estimate);
  EXPECT_TRUE(info.takes_separation);
  EXPECT_EQ(info.batch, 64);
  EXPECT_EQ(info.contract, (Contract{.apart_at_start = true,
                                     .one_root = true,
                                     .apart_by = 0.125,
                                     .grid = 0.25,
                                     .shortest = 0.5,
                                     .longest = 8}));
  EXPECT_EQ(subject->decide(Query{}).time, 0.5);
  EXPECT_EQ(subject->distance_bound(Query{.kind = Kind::edge_edge}), 0.25);
}

TEST_F(ProgramTest, ThatEndsIsACrashOfTheQuery) {
  const Verdict exit = last_verdict(program("if rows[-1][0] == 1: sys.exit(3)"));
  EXPECT_EQ(exit.fault, Fault::crash);
  EXPECT_EQ(exit.fault_code, -3);
  const Verdict crash = last_verdict(program("if rows[-1][0] == 1: os.kill(os.getpid(), signal.SIGSEGV)"));
  EXPECT_EQ(crash.fault, Fault::crash);
  EXPECT_EQ(crash.fault_code, SIGSEGV);
}

TEST_F(ProgramTest, AnExceptionIsKnownByItsText) {
  std::string text;
  EXPECT_EQ(last_verdict(program("if rows[-1][0] == 1: raise ValueError('no root')"), &text).fault,
            Fault::exception);
  EXPECT_EQ(text, "ValueError: no root");
}

TEST_F(ProgramTest, ThatTakesTooLongIsLate) {
  for (const char* way : {"if rows[-1][0] == 1: time.sleep(1000)", "while rows[-1][0] == 1: pass"})
    EXPECT_EQ(last_verdict(program(way)).fault, Fault::time) << way;
}

TEST_F(ProgramTest, AnAnswerThatIsNoneIsInvalid) {
  for (const char* answer : {"0.5", "3", "1e300", "float('nan')"})
    EXPECT_EQ(last_verdict(program(std::string("if rows[-1][0] == 1: answers[-2] = ") + answer)).fault,
              Fault::invalid)
        << answer;
}

// Otherwise the answers to later questions would be those to earlier ones.
TEST_F(ProgramTest, BytesThatAnswerNoQuestionBreakTheProtocol) {
  const std::string numbers = "sys.stdout.buffer.write(struct.pack('<20d', *[1] * 20))";
  for (const std::string& name :
       {program("answers += [0, 0] * (not 'asked' in globals()); asked = True"), program("answers += [0]"),
        program("pass", "\\n')\n" + numbers + "\nsay('")}) {
    const auto subject = make_any_subject(name);
    const std::vector<Query> queries(5);
    std::vector<Verdict> verdicts(queries.size());
    subject->decide(queries, verdicts);
    for (const Verdict& verdict : verdicts) EXPECT_EQ(verdict.fault, Fault::protocol) << name;
  }
}

TEST_F(ProgramTest, ThatLeavesAChildBehindEnds) {
  const Verdict exit =
      last_verdict(program("if rows[-1][0] == 1: subprocess.Popen(['sleep', '1000']); os._exit(5)"));
  EXPECT_EQ(exit.fault, Fault::crash);
  EXPECT_EQ(exit.fault_code, -5);
}

TEST_F(ProgramTest, MayDoSomethingWhenItsInputEnds) {
  const std::string at_exit = "atexit.register(open, '" + file("mark").string() + "', 'w')";
  EXPECT_TRUE(make_any_subject(program(at_exit), std::nullopt, {.leaving = std::chrono::minutes(1)})
                  ->decide(Query{})
                  .hit);
  EXPECT_TRUE(std::filesystem::exists(file("mark")));
}

TEST_F(ProgramTest, ThatSaysNothingIsRefusedAfterTheTimeForLoading) {
  const std::chrono::seconds loading(2);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THAT([&] { make_any_subject("pipe:cat", std::nullopt, {.loading = loading}); },
              ThrowsMessage<Error>(HasSubstr("pipe:cat: the plug-in takes longer than 2 s to load")));
  EXPECT_LT(std::chrono::steady_clock::now() - start, 10 * loading);
}

TEST_F(ProgramTest, ThatIsNoneIsRefused) {
  const auto refused = [&](const std::string& name, const std::string& why) {
    EXPECT_THAT([&] { make_any_subject(name); }, ThrowsMessage<Error>(HasSubstr(why))) << name;
  };
  refused(command("say('nearmiss 1\\n\\n')"), "found 'nearmiss 1', expected 'nearmiss 2'");
  refused(command("say('nearmiss 2\\nname p\\n\\n')"), "'p' with no known kind of queries");
  refused(command("say('nearmiss 2\\nkinds vt\\n\\n')"), "a detector without a name");
  refused(command("say('nearmiss 2\\nname p\\nkinds xy\\n\\n')"),
          "found 'xy', expected one of vt, ee, vt ee");
  refused(command("say('nearmiss 2\\nname p\\ngrid 0.x\\n\\n')"), "found '0.x', expected a number");
  refused(command("say('nearmiss 2\\nname p\\nbits 24.9\\n\\n')"), "found '24.9', expected a whole number");
  refused(command("say('nearmiss 2\\nname p\\nbatch 1e30\\n\\n')"), "found '1e30', expected a whole number");
  refused(command("say('nearmiss 2\\nname p\\nbatch inf\\n\\n')"), "found 'inf', expected a whole number");
  refused(command("say('nearmiss 2\\nnames p\\n\\n')"), "found the line 'names'");
  refused(command("say('nearmiss 2\\nname p\\nkinds vt\\nlongest inf\\n\\n')"),
          "found 'p' with limits of lengths that no length meets, or that are not finite");
  refused(command("say('nearmiss 2\\nname a/p\\nkinds vt\\n\\n')"),
          "found the name 'a/p' with ':', '=', '/' or ','");
  refused(command("import no_such_module"), "No module named 'no_such_module'");
  refused("pipe:no-such-command", "no-such-command: not found");
  refused("pipe:", "pipe: found no command");
}

TEST_F(ProgramTest, IsIdentifiedByAllFilesOfItsCommand) {
  const std::string code = "say('nearmiss 2\\nname p\\nkinds vt\\n\\n')";
  const std::string one = digest(code);
  EXPECT_EQ(digest(code), one);
  EXPECT_NE(digest(code + "\n"), one);
}

TEST_F(ProgramTest, ThatIsChangedIsNoticed) {
  const std::string name = program("pass");
  const auto subject = make_any_subject(name);
  EXPECT_TRUE(subject->decide(Query{}).hit);
  write("p.py", "changed");
  EXPECT_THAT([&] { (void)subject->decide(Query{}); },
              ThrowsMessage<Error>(HasSubstr("p.py: the plug-in was changed")));
}

}  // namespace
}  // namespace nearmiss
