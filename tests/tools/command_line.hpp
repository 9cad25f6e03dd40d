// Runs the command nearmiss for tests, as a user does. Background runs the command in the background, so that
// a test can send signals to it, or run other processes meanwhile.
#pragma once

#include <gmock/gmock.h>
#include <sys/types.h>

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reports/text/json.hpp"
#include "tests/temporary_folder.hpp"

namespace nearmiss::testing {

/// A process in the background that runs "nearmiss ARGUMENTS" in a folder, with variables such as "A=1 B=2"
/// in its environment. The destructor kills the process if it still runs.
class Background {
 public:
  Background(const std::filesystem::path& folder, const std::string& arguments,
             const std::string& variables = "");
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;
  ~Background();

  [[nodiscard]] bool has_ended();

  /// Waits until `is_true()`, or until the process ends. Returns false if the process has ended.
  bool wait_until(const std::function<bool()>& is_true);

  /// Waits until a file changes or appears. Returns false if the process has ended.
  bool wait_for_a_change(const std::filesystem::path& file);

  /// Waits until the process has handlers for SIGINT, SIGTERM and SIGHUP. Returns false if the process has
  /// ended.
  bool wait_until_it_handles_interrupts();

  void send(int signal) const;

  /// Sends a signal, and waits for the process to end.
  void stop(int signal);

  /// The exit code of the process, which must have ended; -1 if a signal ended it.
  [[nodiscard]] int code() const { return code_.value(); }

 private:
  pid_t process_;
  std::optional<int> code_;
};

class CommandLine : public testing::TemporaryFolder {
 protected:
  struct Output {
    int code = -1;
    std::string out, error;
  };

  /// Two queries with the triangle (0,0,0) (1,0,0) (0,1,0). In `hit`, a vertex falls through the triangle
  /// from z = 1 to z = -1; in `miss`, a vertex stays above the triangle.
  static const std::string hit, miss;

  /// Writes `hit` to hit.vt and `miss` to miss.vt.
  CommandLine();

  static std::string plugin(const std::string& name);

  /// Runs "nearmiss ARGUMENTS" in a shell in the test's folder. `before` is put before the command, for
  /// example "ulimit -f 8;". `redirections` is put after the command, for example ">/dev/full" or "<&-".
  [[nodiscard]] Output run(const std::string& arguments, const std::string& before = "",
                           const std::string& redirections = "") const;

  Output expect_code(int code, const std::string& arguments, const std::string& before = "",
                     const std::string& redirections = "") const;

  /// Runs a command with --json -, expects the exit code `code`, and returns the JSON that is printed.
  [[nodiscard]] nlohmann::json json_of(int code, const std::string& arguments,
                                       const std::string& before = "") const;

  /// Runs "nearmiss report STORES", expects the exit code `code`, and returns the content of report.json.
  [[nodiscard]] nlohmann::json report_of(const std::string& stores, int code = 0) const;

  /// An OBJ file of two triangles. The first is at z = 0, and the second is at z = `height`. `last` has x and
  /// y of the second triangle's last vertex.
  static std::string two_triangles(const std::string& height, const std::string& last = "0.5 9");

  /// Writes two_triangles to start.obj and end.obj. Between these frames, the second triangle falls from
  /// z = 1 to z = -1, through the first triangle.
  void write_falling_triangle(const std::string& last = "0.5 9") const;

  /// Expects that nearmiss prints one line to stderr that contains each of `words`, ends with exit code 2,
  /// and makes no file.
  void expect_refused(const std::string& arguments, const std::vector<std::string>& words) const;

  /// Waits until a command has saved at least `cases` cases in a.db. Returns false if the command ends before
  /// that.
  [[nodiscard]] bool wait_for_a_save(Background& command, std::uint64_t cases = 1) const;

  [[nodiscard]] nlohmann::json read_json(const std::string& name) const;
};

}  // namespace nearmiss::testing
