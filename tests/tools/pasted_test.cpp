// nearmiss shrink --as prints tests that compile and run in other projects.
#include <array>
#include <sstream>

#include "corpus/query_text.hpp"
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using ::testing::HasSubstr;

class PastedTest : public testing::CommandLine {
 protected:
  /// Whether a command in the test's folder succeeds; its output is in text.txt.
  [[nodiscard]] bool succeeds(const std::string& command) const {
    return std::system(("cd " + file("").string() + " && " + command + " >text.txt").c_str()) == 0;
  }

  /// The query of the case that `nearmiss shrink` writes.
  [[nodiscard]] std::string numbers_of_case(const std::string& arguments) const {
    std::istringstream lines(run("shrink " + arguments).out);
    std::string numbers;
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with('x') || line.starts_with('y')) numbers += line.substr(2);
    return to_line(parse_line(Kind::vertex_triangle, numbers, arguments));
  }

  /// The query that the test passed to its detector.
  [[nodiscard]] std::string printed_numbers() const {
    return to_line(parse_line(Kind::vertex_triangle, read("text.txt"), "text.txt"));
  }

  /// Compiles a test in C++, with a detector that prints its numbers and gives this answer and time, and runs it.
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

  /// Runs a test in Python, with a detector that prints its numbers and gives this answer and time.
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

TEST_F(PastedTest, PassesInCppIfTheDetectorIsRight) {
  const std::string arguments = NEARMISS_CORPUS "/rounding/vt-planted.case --subject basic";
  const Output test = run("shrink " + arguments + " --as c++");
  EXPECT_EQ(test.code, 0) << test.error;
  EXPECT_THAT(test.out, HasSubstr("// basic reported no collision.\n"));
  EXPECT_THAT(test.out, HasSubstr("// The primitives touch, first "));
  EXPECT_TRUE(passes_in_cpp(test.out, "test_vertex_triangle", "true"));
  EXPECT_EQ(printed_numbers(), numbers_of_case(arguments));
  EXPECT_FALSE(passes_in_cpp(test.out, "test_vertex_triangle", "false"));
}

TEST_F(PastedTest, PassesInPythonIfTheDetectorIsRight) {
  const std::string arguments = NEARMISS_CORPUS "/rounding/vt-planted.case --subject basic";
  EXPECT_EQ(run("shrink " + arguments + " --as python -o new.py").code, 0);
  EXPECT_THAT(read("new.py"), HasSubstr("# basic reported no collision.\n"));
  EXPECT_TRUE(passes_in_python(read("new.py"), "test_vertex_triangle", "True"));
  EXPECT_EQ(printed_numbers(), numbers_of_case(arguments));
  EXPECT_FALSE(passes_in_python(read("new.py"), "test_vertex_triangle", "False"));
  EXPECT_THAT(read("error.txt"), HasSubstr("AssertionError"));
}

TEST_F(PastedTest, ExpectsNoCollisionAfterAReportBeyondTheBound) {
  write("q.ee", "0 0 1  1 0 1.1  0.5 -1 0  0.5 1 0.2   0 0 3  1 0 3.3  0.5 -1 0.1  0.5 1 0\n");
  const std::string arguments = "q.ee --subject " + plugin("bounded");
  const std::string python = run("shrink " + arguments + " --as python").out;
  EXPECT_THAT(python, HasSubstr("# The primitives do not touch at any t in [0, 1].\n"));
  EXPECT_TRUE(passes_in_python(python, "test_edge_edge", "False"));
  EXPECT_FALSE(passes_in_python(python, "test_edge_edge", "True"));
  const std::string cpp = run("shrink " + arguments + " --as c++").out;
  EXPECT_TRUE(passes_in_cpp(cpp, "test_edge_edge", "false"));
  EXPECT_FALSE(passes_in_cpp(cpp, "test_edge_edge", "true"));
}

TEST_F(PastedTest, PassesTheSeparation) {
  write("q.vt", hit);
  const std::string arguments = "q.vt --separation 0.5 --subject " + plugin("never");
  const std::string cpp = run("shrink " + arguments + " --as c++").out;
  EXPECT_THAT(cpp, HasSubstr("// The primitives come within 1 of each other, first "));
  EXPECT_THAT(cpp, HasSubstr("(&end)[4][3], double separation);\n"));
  EXPECT_THAT(cpp, HasSubstr("  return detects(start, end, 1.0) == true;\n"));
  const std::string python = run("shrink " + arguments + " --as python").out;
  EXPECT_THAT(python, HasSubstr("# Write a function detects(start, end, separation) that returns whether "));
  EXPECT_THAT(python, HasSubstr("    assert detects(start, end, 1.0)\n"));
}

TEST_F(PastedTest, ExpectsATimeThatIsNotLate) {
  write("q.vt", "0.25 0.25 1  0 0 0  1 0 0  0 1 0   0.25 0.25 -3  0 0 0  1 0 0  0 1 0\n");
  const std::string arguments = "q.vt --subject " + plugin("promises");
  const std::string python = run("shrink " + arguments + " --as python").out;
  EXPECT_THAT(python, HasSubstr("# always gave a later time as one before which nothing happens.\n"));
  const auto passes = [&](const std::string& time) {
    write("test.py", "import math\n" + python + "def time_of_impact(start, end):\n    return " + time +
                         "\ntest_vertex_triangle()\n");
    return succeeds("python3 test.py 2>error.txt");
  };
  write("shrunk.vt", numbers_of_case(arguments));
  std::istringstream truth(run("oracle --kind vt --toi shrunk.vt").out);
  std::string collides, lo, hi;
  truth >> collides >> lo >> hi;
  EXPECT_TRUE(passes("float.fromhex('" + lo + "')"));
  EXPECT_FALSE(passes("math.nextafter(float.fromhex('" + hi + "'), 2)"));
  const std::string cpp = run("shrink " + arguments + " --as c++").out;
  EXPECT_THAT(
      cpp, HasSubstr("\ndouble time_of_impact(const double (&start)[4][3], const double (&end)[4][3]);\n"));
  EXPECT_THAT(cpp, HasSubstr("  return time_of_impact(start, end) <= "));
}

TEST_F(PastedTest, ExpectsATimeInTheStepWithACollision) {
  write("q.vt", hit);
  const std::string arguments = "q.vt --subject " + plugin("invalid_time");
  const std::string python = run("shrink " + arguments + " --as python").out;
  EXPECT_THAT(python, HasSubstr("# always gave no answer (vt invalid).\n"));
  EXPECT_THAT(python, HasSubstr("# Write a function detects(start, end) that returns "));
  EXPECT_THAT(python, HasSubstr("# Write a function time_of_impact(start, end) that returns "));
  const std::string cpp = run("shrink " + arguments + " --as c++").out;
  const std::string name = "test_vertex_triangle";
  for (const std::string time : {"0", "1"}) {
    EXPECT_TRUE(passes_in_python(python, name, "True", time)) << time;
    EXPECT_TRUE(passes_in_cpp(cpp, name, "true", time)) << time;
  }
  for (const std::string time : {"2", "-1e-300"}) {
    EXPECT_FALSE(passes_in_python(python, name, "True", time)) << time;
    EXPECT_FALSE(passes_in_cpp(cpp, name, "true", time)) << time;
  }
  EXPECT_FALSE(passes_in_python(python, name, "True", "float('nan')"));
  EXPECT_FALSE(passes_in_cpp(cpp, name, "true", "__builtin_nan(\"\")"));
  EXPECT_FALSE(passes_in_python(python, name, "False", "0"));
  EXPECT_FALSE(passes_in_cpp(cpp, name, "false", "0"));
}

TEST_F(PastedTest, ExpectsATimeInTheStepWithAFalsePositive) {
  write("q.vt", miss);
  const std::string arguments = "q.vt --subject " + plugin("invalid_time_above");
  const std::string python = run("shrink " + arguments + " --as python").out;
  EXPECT_THAT(python, HasSubstr("# The primitives do not touch at any t in [0, 1].\n"));
  const std::string cpp = run("shrink " + arguments + " --as c++").out;
  const std::string name = "test_vertex_triangle";
  EXPECT_TRUE(passes_in_python(python, name, "True", "0.5"));
  EXPECT_TRUE(passes_in_cpp(cpp, name, "true", "0.5"));
  EXPECT_FALSE(passes_in_python(python, name, "True", "2"));
  EXPECT_FALSE(passes_in_cpp(cpp, name, "true", "2"));
  EXPECT_TRUE(passes_in_python(python, name, "False", "2"));
  EXPECT_TRUE(passes_in_cpp(cpp, name, "false", "2"));
}

TEST_F(PastedTest, AsksForNoTimeOfASubjectThatGivesNone) {
  write("q.vt", hit);
  const std::string arguments = "q.vt --subject " + plugin("several") + ":told:answer=3";
  const std::string python = run("shrink " + arguments + " --as python").out;
  EXPECT_THAT(python, HasSubstr(" gave no answer (vt invalid).\n"));
  EXPECT_THAT(python, HasSubstr("    assert detects(start, end)\n"));
}

TEST_F(PastedTest, IsWrittenInKnownLanguagesOnly) {
  write("q.vt", hit);
  expect_refused("shrink q.vt --as rust --subject " + plugin("never"),
                 {"--as", "'rust'", "case, c++ or python"});
}

TEST_F(PastedTest, NamesTheDetectorsOfAPluginThatHasSeveral) {
  write("q.vt", hit);
  expect_refused("shrink q.vt --subject " + plugin("several"), {"several detectors", "expected one of"});
  const Output power = run("power --time 1ms --way families --subject " + plugin("several"));
  EXPECT_EQ(power.code, 2);
  EXPECT_THAT(power.error, HasSubstr("several detectors, expected one of told"));
}

}  // namespace
}  // namespace nearmiss
