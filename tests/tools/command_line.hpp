// The command nearmiss, run as a user runs it.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/temporary_folder.hpp"

namespace nearmiss::testing {

class CommandLine : public testing::TemporaryFolder {
 protected:
  struct Answer {
    int code = -1;
    std::string out, error;
  };

  /// A vertex that falls through the triangle (0,0,0) (1,0,0) (0,1,0), from z = 1 to -1, and one that stays
  /// above.
  static inline const std::string hit =
      "0.25 0.25 1  0 0 0  1 0 0  0 1 0   0.25 0.25 -1  0 0 0  1 0 0  0 1 0\n";
  static inline const std::string miss =
      "0.25 0.25 2  0 0 0  1 0 0  0 1 0   0.25 0.25 0x1p0  0 0 0  1 0 0  0 1 0\n";

  static std::string plugin(const std::string& name) { return NEARMISS_PLUGINS "/" + name + ".so"; }

  /// Runs "nearmiss ARGUMENTS" in a shell in the test's folder; `before` is put in front, such as "ulimit -f
  /// 8;".
  [[nodiscard]] Answer run(const std::string& arguments, const std::string& before = "") const {
    const std::string command = "cd " + file("").string() + " && " + before + " " + NEARMISS_EXECUTABLE +
                                " " + arguments + " >out.txt 2>error.txt";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read("out.txt"), read("error.txt")};
  }

  /// One line on stderr with all of these words, exit code 2, and no file that was not there before.
  void expect_refused(const std::string& arguments, const std::vector<std::string>& words) const {
    const Answer answer = run(arguments);
    EXPECT_EQ(answer.code, 2) << arguments;
    EXPECT_EQ(std::count(answer.error.begin(), answer.error.end(), '\n'), 1)
        << arguments << ": " << answer.error;
    EXPECT_THAT(answer.error, ::testing::StartsWith("nearmiss: ")) << arguments;
    for (const std::string& word : words) EXPECT_THAT(answer.error, ::testing::HasSubstr(word)) << arguments;
    for (const char* name : {"new.db", "new.db-wal", "new.json", "new.json.part", "new"})
      EXPECT_FALSE(std::filesystem::exists(file(name))) << arguments << " left " << name;
  }

  [[nodiscard]] nlohmann::json read_json(const std::string& name) const {
    return nlohmann::json::parse(read(name));
  }
};

}  // namespace nearmiss::testing
