// Runs the command nearmiss as a user does.
#pragma once

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "reports/text/json.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/tools/background.hpp"

namespace nearmiss::testing {

class CommandLine : public testing::TemporaryFolder {
 protected:
  struct Output {
    int code = -1;
    std::string out, error;
  };

  /// Two queries with the triangle (0,0,0) (1,0,0) (0,1,0). In `hit`, a vertex falls through the triangle
  /// from z = 1 to z = -1; in `miss`, a vertex stays above the triangle.
  static inline const std::string hit =
      "0.25 0.25 1  0 0 0  1 0 0  0 1 0   0.25 0.25 -1  0 0 0  1 0 0  0 1 0\n";
  static inline const std::string miss =
      "0.25 0.25 2  0 0 0  1 0 0  0 1 0   0.25 0.25 0x1p0  0 0 0  1 0 0  0 1 0\n";

  /// Writes these queries to hit.vt and miss.vt.
  CommandLine() {
    write("hit.vt", hit);
    write("miss.vt", miss);
  }

  static std::string plugin(const std::string& name) { return NEARMISS_PLUGINS "/" + name + ".so"; }

  /// Runs "nearmiss ARGUMENTS" in a shell in the test's folder. `before` stands before the command, for
  /// example "ulimit -f 8;", and `redirections` after it, for example ">/dev/full" or "<&-".
  [[nodiscard]] Output run(const std::string& arguments, const std::string& before = "",
                           const std::string& redirections = "") const {
    const std::string command = "cd " + file("").string() + " && " + before + " " + NEARMISS_EXECUTABLE +
                                " " + arguments + " >out.txt 2>error.txt " + redirections;
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read("out.txt"), read("error.txt")};
  }

  /// Runs a command as `run` does, and expects an exit code.
  Output expect_code(int code, const std::string& arguments, const std::string& before = "",
                     const std::string& redirections = "") const {
    Output output = run(arguments, before, redirections);
    EXPECT_EQ(output.code, code) << before << " nearmiss " << arguments << ": " << output.error;
    return output;
  }

  /// The JSON that a command prints with --json -. Expects that the command ends with this exit code.
  [[nodiscard]] nlohmann::json json_of(int code, const std::string& arguments,
                                       const std::string& before = "") const {
    return nlohmann::json::parse(expect_code(code, arguments + " --json -", before).out);
  }

  /// The report.json of "nearmiss report STORES". Expects that the command ends with this exit code.
  [[nodiscard]] nlohmann::json report_of(const std::string& stores, int code = 0) const {
    expect_code(code, "report " + stores + " -o report");
    return read_json("report/report.json");
  }

  /// A mesh of two triangles, one at z = 0 and one at z = `height`. `last` has x and y of the last vertex of
  /// the second triangle.
  static std::string two_triangles(const std::string& height, const std::string& last = "0.5 9") {
    return "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0.5 0.5 " + height + "\nv 1 0.5 " + height + "\nv " + last + " " +
           height + "\nf 1 2 3\nf 4 5 6\n";
  }

  /// Writes start.obj and end.obj. From one to the other, the upper triangle of two_triangles falls through
  /// the lower triangle.
  void write_falling_triangle(const std::string& last = "0.5 9") const {
    write("start.obj", two_triangles("1", last));
    write("end.obj", two_triangles("-1", last));
  }

  /// Expects that nearmiss prints one line to stderr with all of these words, ends with exit code 2, and
  /// makes no file.
  void expect_refused(const std::string& arguments, const std::vector<std::string>& words) const {
    const Output output = run(arguments);
    EXPECT_EQ(output.code, 2) << arguments;
    EXPECT_EQ(std::count(output.error.begin(), output.error.end(), '\n'), 1)
        << arguments << ": " << output.error;
    EXPECT_THAT(output.error, ::testing::StartsWith("nearmiss: ")) << arguments;
    for (const std::string& word : words) EXPECT_THAT(output.error, ::testing::HasSubstr(word)) << arguments;
    for (const char* name : {"new.db", "new.db-wal", "new.json", "new.json.part", "new"})
      EXPECT_FALSE(std::filesystem::exists(file(name))) << arguments << " left " << name;
  }

  /// Waits until a command has saved at least this many cases in a.db. Returns false if the command ends
  /// before that.
  [[nodiscard]] bool wait_for_a_save(Background& command, std::uint64_t cases = 1) const {
    const auto has_cases = [&] {
      return run("report a.db -o saved").code <= 1 &&
             read_json("saved/report.json")["runs"][0]["cases_done"] >= cases;
    };
    while (command.wait_for_a_change(file("a.db-wal")))
      if (has_cases()) return true;
    return false;
  }

  [[nodiscard]] nlohmann::json read_json(const std::string& name) const {
    return nlohmann::json::parse(read(name));
  }
};

}  // namespace nearmiss::testing
