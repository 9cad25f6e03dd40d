// Detectors that are programs (fuzz/subjects/PROGRAMS.md).
#include <gmock/gmock.h>

#include <array>
#include <fstream>
#include <sstream>
#include <string>

#include "fuzz/subjects/subjects.hpp"
#include "tests/fuzz/family_queries.hpp"
#include "tests/plugins.hpp"
#include "tests/refused.hpp"
#include "tests/temporary_folder.hpp"

namespace nearmiss {
namespace {

using testing::answers_of;

class ProgramTest : public testing::TemporaryFolder {
 protected:
  /// A program that reports every query at t = 0.5. Before the program answers a request, it runs the code
  /// `then`, which can read the queries in `rows` and change `answers`. When the program describes itself,
  /// the description ends with `lines`.
  [[nodiscard]] std::string program(const std::string& then, const std::string& lines = "") const {
    return command("say('nearmiss 3\\nname p\\nkinds vt ee vv ve\\nbatch 64\\n" + lines + R"(\n')
while header := sys.stdin.buffer.read(24):
    question, kind, n = map(int, struct.unpack('<3d', header))
    numbers = {4: 13, 8: 19}.get(kind, 25)
    rows = [struct.unpack(f'<{numbers}d', sys.stdin.buffer.read(8 * numbers)) for i in range(n)]
    answers = [1, 0.5] * n
    )" + then + R"(
    sys.stdout.buffer.write(struct.pack(f'<{len(answers)}d', *answers))
    sys.stdout.buffer.flush()
)");
  }

  /// The subject's name for a program with this Python code.
  [[nodiscard]] std::string command(const std::string& code) const {
    const std::string text =
        "import atexit, os, signal, struct, subprocess, sys, time\n"
        "def say(text):\n    sys.stdout.write(text)\n    sys.stdout.flush()\n" +
        code;
    return "pipe:" NEARMISS_PYTHON " " + write("p.py", text).string();
  }

  /// Asks program(then) about three queries, and only the last of these queries has x[0] = 1. The last query
  /// must get this fault, with this code and text.
  void expect_fault(const std::string& then, Fault fault, int code = 0, const std::string& text = "") const {
    const auto time = std::chrono::milliseconds(fault == Fault::time ? 40 : 200);
    const auto subject = make_any_subject(program(then), std::nullopt, {.time = time});
    std::vector<Query> queries(3);
    queries.back().x[0] = 1;
    const auto verdicts = answers_of(*subject, queries);
    EXPECT_EQ(verdicts[0].fault, Fault::none) << then;
    EXPECT_EQ(verdicts[1].fault, Fault::none) << then;
    EXPECT_EQ(verdicts[2].fault, fault) << then;
    if (fault == Fault::crash) {
      EXPECT_EQ(verdicts[2].fault_code, code) << then;
    }
    EXPECT_EQ(subject->fault_text(verdicts[2]), text) << then;
    if (!text.empty()) {
      EXPECT_THAT(subject->fault_errors(verdicts[2]), ::testing::EndsWith(text + "\n")) << then;
    }
  }
};

TEST_F(ProgramTest, TheExampleAnswersAsTheSharedObjectDoes) {
  const auto program = make_any_subject("pipe:" NEARMISS_PYTHON " " NEARMISS_EXAMPLES "/example.py");
  const auto object = make_any_subject(testing::plugin("example"));
  EXPECT_EQ(program->name(), "boxes-numpy");
  const auto queries = testing::first_queries("planted", 600);
  std::vector<Verdict> of_program(queries.size());
  EXPECT_EQ(program->decide_timed(queries, of_program).queries, queries.size());
  const auto of_object = answers_of(*object, queries);
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
  EXPECT_EQ(info.separation_kinds, info.kinds);
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

TEST_F(ProgramTest, GivesDistances) {
  // If the question is the distance of a vertex and an edge, the program gets their nine coordinates at t =
  // 0. In place of the coordinates at t = 1, it gets the same nine numbers again.
  const auto subject = make_any_subject(
      program("if question == 2: answers = [rows[0][8] if rows[0][:9] == rows[0][9:18] else -1, 0]",
              "distance ve\\n"));
  EXPECT_TRUE(subject->gives_distance(Kind::vertex_edge));
  EXPECT_FALSE(subject->gives_distance(Kind::edge_edge));
  Query query{.kind = Kind::vertex_edge};
  query.x[8] = 0.5;
  query.x[20] = 7;  // a coordinate at t = 1, which does not affect the distance at t = 0
  EXPECT_EQ(subject->ask_distance(query).distance, 0.5);
}

TEST_F(ProgramTest, FiltersSteps) {
  for (const bool says_seconds : {false, true}) {
    const std::string then = "if question == 3: answers = [0.125] + list(rows[0][6:12])";
    const auto subject = make_any_subject(
        says_seconds ? program(then + " + [1e-6]", "step vv\\nseconds yes\\n") : program(then, "step vv\\n"));
    EXPECT_TRUE(subject->filters_step(Kind::vertex_vertex));
    Query query{.kind = Kind::vertex_vertex};
    query.x[12] = 7;  // x0 at t = 1
    const StepAnswer answer = subject->ask_step(query);
    EXPECT_EQ(answer.fault, Fault::none);
    EXPECT_EQ(answer.y[0], 7);
    EXPECT_EQ(answer.clearance, 0.125);
  }
}

// The program reports a collision if the last number of a query's row, the separation, is equal to the last
// coordinate.
TEST_F(ProgramTest, GetsTheNumbersOfEachKindAndTheSeparation) {
  const std::string then =
      "if question == 1: answers = [rows[0][-1] + len(rows[0]), 0]\n"
      "    else: answers = [x for row in rows for x in (row[-1] == row[-2], 0.5)]";
  const auto subject = make_any_subject(program(then, "separation ee ve\\nbound yes\\n"));
  std::array<double, 24> numbers{};
  for (const Kind kind : kinds) {
    const bool is_asked = kind == Kind::edge_edge || kind == Kind::vertex_edge;
    EXPECT_EQ(subject->takes_separation(kind), is_asked);
    numbers[coordinate_count(kind) - 1] = is_asked ? 2 : 0;
    const Query query = with_separation(query_of(kind, numbers.data()), is_asked ? 2 : 0);
    Query other = query;
    other.separation = is_asked ? 1 : 0;
    EXPECT_TRUE(subject->decide(query).hit) << short_name(kind);
    EXPECT_EQ(subject->decide(other).hit, !is_asked) << short_name(kind);
    EXPECT_EQ(subject->distance_bound(query),
              query.separation + static_cast<double>(coordinate_count(kind)) + 1);
  }
}

TEST_F(ProgramTest, OfVersion2IsAskedForBoundsWithoutTheSeparation) {
  const std::string text =
      program("if question == 1: answers = [rows[0][-1] + 0.5, 0]", "separation yes\\nbound yes\\n");
  const Query query{.separation = 2};
  EXPECT_EQ(make_any_subject(text)->distance_bound(query), 2.5);
  const std::string file = text.substr(text.rfind(' ') + 1);
  std::stringstream code;
  code << std::ifstream(file).rdbuf();
  std::string older = code.str();
  older.replace(older.find("nearmiss 3"), 10, "nearmiss 2");
  std::ofstream(file) << older;
  EXPECT_EQ(make_any_subject(text)->distance_bound(query), 0.5);
}

// The program gives the last coordinate of each query as the time of impact, and says how long its answers
// took.
TEST_F(ProgramTest, MayReadArraysAndSayItsTimeWithoutCopies) {
  const auto subject = make_any_subject(command(R"(
say('nearmiss 4\nname p\nkinds vt vv\nbatch 5000\ntime estimate\nlayout arrays\nseconds yes\n\n')
while header := sys.stdin.buffer.read(24):
    question, kind, n = map(int, struct.unpack('<3d', header))
    columns = [struct.unpack(f'<{n}d', sys.stdin.buffer.read(8 * n)) for k in range({4: 13}.get(kind, 25))]
    answers = [x for time in columns[-2] for x in (1, time)] + [1e5]
    sys.stdout.buffer.write(struct.pack(f'<{len(answers)}d', *answers))
    sys.stdout.buffer.flush()
)"),
                                        std::nullopt, {.time = std::chrono::minutes(1)});
  for (const Kind kind : {Kind::vertex_triangle, Kind::vertex_vertex}) {
    std::vector<Query> queries(5000, Query{.kind = kind});
    for (std::size_t i = 0; i < queries.size(); ++i)
      queries[i].x[12 + coordinate_count(kind) / 2 - 1] = static_cast<double>(i) / 8192;
    std::vector<Verdict> verdicts(queries.size());
    const BatchTime time = subject->decide_timed(queries, verdicts);
    EXPECT_EQ(time.kernel_nanoseconds, time.nanoseconds);
    for (std::size_t i = 0; i < queries.size(); ++i)
      ASSERT_EQ(verdicts[i].time, static_cast<double>(i) / 8192);
  }
}

TEST_F(ProgramTest, ThatFailsIsAFaultOfTheQuery) {
  expect_fault("if rows[-1][0] == 1: sys.exit(3)", Fault::crash, -3);
  expect_fault("if rows[-1][0] == 1: os.kill(os.getpid(), signal.SIGSEGV)", Fault::crash, SIGSEGV);
  // A child process that the program leaves behind does not change the fault.
  expect_fault("if rows[-1][0] == 1: subprocess.Popen(['sleep', '1000']); os._exit(5)", Fault::crash, -5);
  expect_fault("if rows[-1][0] == 1: raise ValueError('no root')", Fault::exception, 0,
               "ValueError: no root");
  for (const std::string answer : {"0.5", "1e300", "float('nan')"})
    expect_fault("if rows[-1][0] == 1: answers[-2] = " + answer, Fault::invalid);
}

TEST_F(ProgramTest, ThatTakesTooLongIsLate) {
  expect_fault("if rows[-1][0] == 1: time.sleep(1000)", Fault::time);
  expect_fault("while rows[-1][0] == 1: pass", Fault::time);
}

// If nearmiss accepted more bytes than the answers have, the surplus bytes would become the answers to later
// questions.
TEST_F(ProgramTest, BytesThatAnswerNoQuestionBreakTheProtocol) {
  const std::string numbers = "sys.stdout.buffer.write(struct.pack('<20d', *[1] * 20))";
  for (const std::string& name :
       {program("answers += [0, 0] * (not 'asked' in globals()); asked = True"), program("answers += [0]"),
        program("pass", "\\n')\n" + numbers + "\nsay('")}) {
    const auto subject = make_any_subject(name);
    for (const Verdict& verdict : answers_of(*subject, std::vector<Query>(5)))
      EXPECT_EQ(verdict.fault, Fault::protocol) << name;
  }
}

TEST_F(ProgramTest, MayDoSomethingWhenItsInputEnds) {
  const std::string at_exit = "atexit.register(open, '" + file("mark").string() + "', 'w')";
  EXPECT_TRUE(make_any_subject(program(at_exit), std::nullopt, {.leaving = std::chrono::minutes(1)})
                  ->decide(Query{})
                  .hit);
  EXPECT_TRUE(std::filesystem::exists(file("mark")));
}

TEST_F(ProgramTest, ThatSaysNothingIsRefusedAfterTheTimeForLoading) {
  const std::chrono::milliseconds loading(600);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_REFUSED(make_any_subject("pipe:cat", std::nullopt, {.loading = loading}),
                 "pipe:cat: the plug-in takes longer than 1 s to load");
  EXPECT_LT(std::chrono::steady_clock::now() - start, 10 * loading);
}

TEST_F(ProgramTest, ThatIsNoneIsRefused) {
  const std::pair<const char*, const char*> descriptions[]{
      {"nearmiss 1\\n", "found 'nearmiss 1', expected 'nearmiss 4', or an earlier version"},
      {"nearmiss 3\\nname p\\n", "'p' with no known kind of queries"},
      {"nearmiss 3\\nkinds vt\\n", "a detector without a name"},
      {"nearmiss 3\\nname p\\nkinds xy\\n", "found 'xy', expected some of vt ee vv ve, each once"},
      {"nearmiss 3\\nname p\\nkinds vt\\nseparation ve\\n",
       "'p' with separations for a kind of queries that it does not decide"},
      {"nearmiss 3\\nname p\\ngrid 0.x\\n", "found '0.x', expected a number"},
      {"nearmiss 3\\nname p\\nbatch 1e30\\n", "found '1e30', expected a whole number"},
      {"nearmiss 3\\nnames p\\n", "found the line 'names'"},
      {"nearmiss 4\\nname p\\nlayout columns\\n", "found 'columns', expected one of rows, arrays"},
      {"nearmiss 3\\nname a\\0b\\nkinds vt\\n", "found a NUL character in 'name a?b', expected text"},
      {"nearmiss 3\\nname a\\nname b\\nkinds vt\\n", "found the line 'name' twice, expected it once"},
      {"nearmiss 3\\nname p\\nkinds vt\\nlongest inf\\n",
       "found 'p' with limits of lengths that no length meets, or that are not finite"},
      {"nearmiss 3\\nname oracle\\nkinds vt\\n", "found the name 'oracle', under which"}};
  for (const auto& each : descriptions)
    EXPECT_REFUSED(make_any_subject(command("say('" + std::string(each.first) + "\\n')")), each.second);
  EXPECT_REFUSED(make_any_subject(command("import no_such_module")), "No module named 'no_such_module'");
  EXPECT_REFUSED(make_any_subject("pipe:no-such-command"), "no-such-command: not found");
  EXPECT_REFUSED(make_any_subject("pipe:"), "pipe: found no command");
}

TEST_F(ProgramTest, ThatIsChangedIsNoticed) {
  const std::string name = program("pass");
  const auto subject = make_any_subject(name);
  EXPECT_TRUE(subject->decide(Query{}).hit);
  write("p.py", "changed");
  EXPECT_REFUSED(subject->decide(Query{}), "p.py: the plug-in was changed");
}

}  // namespace
}  // namespace nearmiss
