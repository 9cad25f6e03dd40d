// Runs the command nearmiss as a user does.
#pragma once

#include <cstdint>
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
  static const std::string hit, miss;

  /// Writes these queries to hit.vt and miss.vt.
  CommandLine();

  static std::string plugin(const std::string& name);

  /// Runs "nearmiss ARGUMENTS" in a shell in the test's folder. `before` stands before the command, for
  /// example "ulimit -f 8;", and `redirections` after it, for example ">/dev/full" or "<&-".
  [[nodiscard]] Output run(const std::string& arguments, const std::string& before = "",
                           const std::string& redirections = "") const;

  /// Runs a command as `run` does, and expects an exit code.
  Output expect_code(int code, const std::string& arguments, const std::string& before = "",
                     const std::string& redirections = "") const;

  /// The JSON that a command prints with --json -. Expects that the command ends with this exit code.
  [[nodiscard]] nlohmann::json json_of(int code, const std::string& arguments,
                                       const std::string& before = "") const;

  /// The report.json of "nearmiss report STORES". Expects that the command ends with this exit code.
  [[nodiscard]] nlohmann::json report_of(const std::string& stores, int code = 0) const;

  /// A mesh of two triangles, one at z = 0 and one at z = `height`. `last` has x and y of the last vertex of
  /// the second triangle.
  static std::string two_triangles(const std::string& height, const std::string& last = "0.5 9");

  /// Writes start.obj and end.obj. From one to the other, the upper triangle of two_triangles falls through
  /// the lower triangle.
  void write_falling_triangle(const std::string& last = "0.5 9") const;

  /// Expects that nearmiss prints one line to stderr with all of these words, ends with exit code 2, and
  /// makes no file.
  void expect_refused(const std::string& arguments, const std::vector<std::string>& words) const;

  /// Waits until a command has saved at least this many cases in a.db. Returns false if the command ends
  /// before that.
  [[nodiscard]] bool wait_for_a_save(Background& command, std::uint64_t cases = 1) const;

  [[nodiscard]] nlohmann::json read_json(const std::string& name) const;
};

}  // namespace nearmiss::testing
