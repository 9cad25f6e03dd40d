// Tests the certificates of findings and of recorded truths. Also runs the tests that `nearmiss shrink --as
// c++` and `--as python` print for other projects.
#include <sstream>

#include "corpus/query_text.hpp"
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using testing::CommandLine;
using ::testing::HasSubstr;

class PastedTest : public testing::CommandLine {
 protected:
  /// Copies the checker of certificates into the test's folder, because the printed tests in Python import
  /// it.
  void SetUp() override { std::filesystem::copy_file(NEARMISS_CHECKER, file("check.py")); }

  /// Whether a command in the test's folder succeeds. Writes the command's output to text.txt.
  [[nodiscard]] bool succeeds(const std::string& command) const {
    return std::system(("cd " + file("").string() + " && " + command + " >text.txt").c_str()) == 0;
  }

  /// The query of the case that `nearmiss shrink` prints.
  [[nodiscard]] std::string numbers_of_case(const std::string& arguments) const {
    std::istringstream lines(run("shrink " + arguments).out);
    std::string numbers;
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with('x') || line.starts_with('y')) numbers += line.substr(2);
    return to_line(parse_line(Kind::vertex_triangle, numbers, arguments));
  }

  /// The query that the printed test passed to the detector. The detector has printed this query to text.txt.
  [[nodiscard]] std::string printed_numbers() const {
    return to_line(parse_line(Kind::vertex_triangle, read("text.txt"), "text.txt"));
  }

  struct Tests {
    std::string cpp, python;
  };
  [[nodiscard]] Tests tests_of(const std::string& arguments) const {
    return {run("shrink " + arguments + " --as c++").out, run("shrink " + arguments + " --as python").out};
  }

  /// Whether a test in C++ passes if its detector returns `answer` and `time`. The detector also prints the
  /// coordinates that it gets.
  [[nodiscard]] bool passes_in_cpp(const std::string& test, const std::string& name,
                                   const std::string& answer, const std::string& time = "0") const {
    write("test.cpp", test +
                          "#include <cstdio>\n#include <initializer_list>\n"
                          "bool detects(const double (&start)[4][3], const double (&end)[4][3]) {\n"
                          "  for (const auto* points : {&start, &end})\n"
                          "    for (const auto& point : *points)\n"
                          "      for (const double x : point) std::printf(\"%a \", x);\n"
                          "  return ANSWER;\n"
                          "}\n"
                          "double time_of_impact(const double (&)[4][3], const double (&)[4][3]) {\n"
                          "  return TIME;\n"
                          "}\n"
                          "int main() { return TEST() ? 0 : 1; }\n");
    const std::string options = "-std=c++17 -Wall -Wextra -Wpedantic -Werror -DTEST=" + name +
                                " -DANSWER=" + answer + " '-DTIME=" + time + "'";
    EXPECT_TRUE(succeeds("g++ " + options + " test.cpp -o test"));
    return succeeds("./test");
  }

  /// Runs the tests in C++ and in Python with a detector that returns `answer` and `time`. Expects that both
  /// tests pass or, if `pass` is false, that both fail.
  void expect_both(bool pass, const Tests& tests, const std::string& name, bool answer,
                   const std::string& time = "0") const {
    const bool is_number = time != "nan";
    EXPECT_EQ(
        passes_in_python(tests.python, name, answer ? "True" : "False", is_number ? time : "float('nan')"),
        pass)
        << answer << ' ' << time;
    EXPECT_EQ(
        passes_in_cpp(tests.cpp, name, answer ? "true" : "false", is_number ? time : "__builtin_nan(\"\")"),
        pass)
        << answer << ' ' << time;
  }

  /// Whether a test in Python passes if its detector returns `answer` and `time`. The detector also prints
  /// the coordinates that it gets.
  [[nodiscard]] bool passes_in_python(const std::string& test, const std::string& name,
                                      const std::string& answer, const std::string& time = "0") const {
    write("test.py", test +
                         "def detects(start, end):\n"
                         "    print(*(float(x).hex() for point in start + end for x in point), end=' ')\n"
                         "    return " +
                         answer + "\ndef time_of_impact(start, end):\n    return " + time + "\n" + name +
                         "()\n");
    return succeeds("python3 test.py 2>error.txt");
  }
};

TEST_F(PastedTest, PassesIfTheDetectorIsRight) {
  const std::string arguments = NEARMISS_CORPUS "/rounding/vt-planted.case --subject basic";
  const Tests tests = tests_of(arguments);
  for (const auto& [test, mark] : {std::pair{tests.cpp, "// "}, std::pair{tests.python, "# "}}) {
    EXPECT_THAT(test, HasSubstr(std::string(mark) + "basic reported no collision.\n"));
    EXPECT_THAT(test, HasSubstr(std::string(mark) + "The primitives touch, first "));
  }
  const std::string numbers = numbers_of_case(arguments);
  EXPECT_TRUE(passes_in_cpp(tests.cpp, "test_vertex_triangle", "true"));
  EXPECT_EQ(printed_numbers(), numbers);
  EXPECT_FALSE(passes_in_cpp(tests.cpp, "test_vertex_triangle", "false"));
  EXPECT_TRUE(passes_in_python(tests.python, "test_vertex_triangle", "True"));
  EXPECT_EQ(printed_numbers(), numbers);
  EXPECT_FALSE(passes_in_python(tests.python, "test_vertex_triangle", "False"));
  EXPECT_THAT(read("error.txt"), HasSubstr("AssertionError"));
  write("g.cpp", run("shrink " + arguments + " --as gtest").out +
                     "#include <cstdlib>\nbool detects(const double (&)[4][3], const double (&)[4][3]) {\n"
                     "  return std::getenv(\"HIT\") != nullptr;\n}\n");
  EXPECT_TRUE(succeeds("g++ -std=c++17 -Wall -Wextra -Werror g.cpp -o g -lgtest -lgtest_main"));
  EXPECT_TRUE(succeeds("HIT=1 ./g"));
  EXPECT_FALSE(succeeds("./g"));
  EXPECT_THAT(read("text.txt"), HasSubstr("Ccd.vertex_triangle"));
}

/// Replaces `old` by `part` in a text, which must contain `old`.
std::string with(std::string text, const std::string& old, const std::string& part) {
  EXPECT_THAT(text, HasSubstr(old));
  return text.replace(text.find(old), old.size(), part);
}

TEST_F(PastedTest, ProvesItsOwnExpectation) {
  const auto [cpp, test] = tests_of("hit.vt --subject " + plugin("never"));
  EXPECT_THAT(test, HasSubstr("# Copy check.py, the checker of certificates, beside"));
  EXPECT_THAT(test, HasSubstr("    proven = 'vt', x, 0.0, 'meets', 0.0, 1.0, False, False\n"));
  const auto passes = [&](const std::string& changed) {
    return passes_in_python(changed, "test_vertex_triangle", "True");
  };
  EXPECT_TRUE(passes(test));
  EXPECT_FALSE(
      passes(with(test, "    end = [\n        [", "    end = [\n        [1.0 + ")));  // another query
  EXPECT_THAT(read("error.txt"), HasSubstr("assert check.check(CERTIFICATE) == check.Statement(*proven)"));
  EXPECT_FALSE(passes(with(test, "'meets', 0.0, 1.0", "'meets', 0.0, 0.75")));  // another claim
  EXPECT_FALSE(passes(with(test, R"("h":"0")", R"("h":"1")")));                 // another certificate
  // The test in C++ has the certificate in a comment.
  const std::string beginning = "\n// {";
  const auto first = cpp.find(beginning) + beginning.size() - 1;
  write("certificate.jsonl", cpp.substr(first, cpp.find('\n', first) + 1 - first));
  EXPECT_TRUE(succeeds("python3 check.py certificate.jsonl"));
  EXPECT_EQ(read("text.txt"), "accepted 1 of 1\n");
}

TEST_F(PastedTest, ExpectsNoCollisionAfterAReportBeyondTheBound) {
  write("q.ee", "0 0 1  1 0 1.1  0.5 -1 0  0.5 1 0.2   0 0 3  1 0 3.3  0.5 -1 0.1  0.5 1 0\n");
  const Tests tests = tests_of("q.ee --subject " + plugin("bounded"));
  EXPECT_THAT(tests.python, HasSubstr("# The primitives do not touch at any t in [0, 1].\n"));
  EXPECT_THAT(tests.python, HasSubstr("'apart', 0.0, 1.0, False, True\n"));
  expect_both(true, tests, "test_edge_edge", false);
  expect_both(false, tests, "test_edge_edge", true);
}

TEST_F(PastedTest, PassesTheSeparation) {
  const auto [cpp, python] = tests_of("hit.vt --separation 0.5 --subject " + plugin("never"));
  for (const char* line :
       {"// The primitives come within 1 of each other, first ", "(&end)[4][3], double separation);\n",
        "  return detects(start, end, 1.0) == true;\n"})
    EXPECT_THAT(cpp, HasSubstr(line));
  for (const char* line : {"# Write a function detects(start, end, separation) that returns whether ",
                           "    proven = 'vt', x, 1.0, 'meets', 0.0, 1.0, False, True\n",
                           "    assert detects(start, end, 1.0)\n"})
    EXPECT_THAT(python, HasSubstr(line));
}

TEST_F(PastedTest, ExpectsATimeThatIsNotLate) {
  write("q.vt", "0.25 0.25 1  0 0 0  1 0 0  0 1 0   0.25 0.25 -3  0 0 0  1 0 0  0 1 0\n");
  const std::string arguments = "q.vt --subject " + plugin("promises");
  const Tests tests = tests_of(arguments);
  EXPECT_THAT(tests.python, HasSubstr("# always gave a later time as one before which nothing happens.\n"));
  EXPECT_THAT(tests.cpp, HasSubstr("  return time_of_impact(start, end) <= "));
  write("shrunk.vt", numbers_of_case(arguments));
  std::istringstream truth(run("oracle --kind vt --toi shrunk.vt").out);
  std::string collides, lo, hi;
  truth >> collides >> lo >> hi;
  const auto passes = [&](const std::string& time) {
    return passes_in_python(tests.python, "test_vertex_triangle", "True", time);
  };
  EXPECT_TRUE(passes("float.fromhex('" + lo + "')"));
  EXPECT_FALSE(passes("__import__('math').nextafter(float.fromhex('" + hi + "'), 2)"));
}

TEST_F(PastedTest, ExpectsATimeInTheStep) {
  const std::string name = "test_vertex_triangle";
  write("zero.vt", "0 0 0  0 0 0  0 0 0  0 0 0   0 0 0  0 0 0  0 0 0  0 0 0\n");  // stays a collision
  const Tests of_collision = tests_of("zero.vt --subject " + plugin("invalid_time"));
  EXPECT_THAT(of_collision.python, HasSubstr("# always gave no answer (vt invalid time).\n"));
  for (const char* function : {"detects", "time_of_impact"})
    EXPECT_THAT(of_collision.python,
                HasSubstr(std::string("# Write a function ") + function + "(start, end) that returns "));
  for (const char* time : {"0", "1"}) expect_both(true, of_collision, name, true, time);
  for (const char* time : {"-1e-300", "nan"}) expect_both(false, of_collision, name, true, time);
  expect_both(false, of_collision, name, false);
  const Tests of_false_positive = tests_of("miss.vt --subject " + plugin("invalid_time_above"));
  expect_both(true, of_false_positive, name, true, "0.5");
  expect_both(false, of_false_positive, name, true, "2");
  expect_both(true, of_false_positive, name, false, "2");
  // If the subject gives no time, the printed test does not call time_of_impact.
  const std::string python = tests_of("zero.vt --subject " + plugin("several") + ":told:answer=3").python;
  EXPECT_THAT(python, HasSubstr(" gave no answer (vt invalid answer).\n"));
  EXPECT_THAT(python, HasSubstr("    assert detects(start, end)\n"));
}

TEST_F(PastedTest, IsWrittenInKnownLanguagesOnly) {
  expect_refused("shrink hit.vt --as rust --subject " + plugin("never"),
                 {"--as", "'rust'", "case, c++, gtest or python"});
}

class Certified : public CommandLine {
 protected:
  /// The output of check.py for `certificates`, a text with one certificate on each line.
  [[nodiscard]] std::string checked(const std::string& certificates) const {
    write("certificates.jsonl", certificates);
    const std::string command = "cd " + file("").string() + " && python3 " NEARMISS_CHECKER;
    EXPECT_EQ(std::system((command + " certificates.jsonl >said.txt").c_str()), 0);
    return read("said.txt");
  }
};

TEST_F(Certified, ReplayDemandsACertificateOfEachRecordedTruth) {
  const std::string command = "replay " NEARMISS_CORPUS "/rounding --subject wang --json new.json";
  EXPECT_THAT(expect_code(0, command).out, Not(HasSubstr("certified")));
  const std::uint64_t cases = read_json("new.json")["oracle"]["total"]["queries"];
  ASSERT_GT(cases, 1);
  EXPECT_THAT(expect_code(0, command + " --certify").out,
              HasSubstr("\n" + std::to_string(cases) + " recorded truths are certified\n"));
  const auto json = read_json("new.json");
  EXPECT_EQ(json["oracle"]["total"]["certified"], cases);
  EXPECT_THAT(json["runs"][0]["again"], HasSubstr(" --certify"));
}

TEST_F(Certified, AReportHasTheCertificatesOfItsFindings) {
  const std::string subjects = "basic," + plugin("promises") + "," + plugin("bounded");
  for (const char* shrinking : {"", " --no-shrink"}) {
    const std::string trial = "--family uniform,parallel --cases 400 -q --subject " + subjects;
    expect_code(1, "fuzz " + trial + shrinking + " --db a.db");
    std::string certificates;
    std::set<std::string> sorts;
    const auto json = report_of("a.db", 1);
    for (const auto& each : json["findings"]) {
      certificates += each["certificate"].get<std::string>() + "\n";
      sorts.insert(each["what"]);
    }
    EXPECT_THAT(sorts, ::testing::ElementsAre("false-negative", "late", "refuted-bound"));
    const std::string all = std::to_string(json["findings"].size());
    EXPECT_EQ(checked(certificates), "accepted " + all + " of " + all + "\n");
    std::filesystem::remove(file("a.db"));
  }
}

}  // namespace
}  // namespace nearmiss
