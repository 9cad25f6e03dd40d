// Reports read the tables of other commands.
#include "reports/sections/other_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>

#include "reports/text/json.hpp"
#include "tests/refused.hpp"
#include "tests/temporary_folder.hpp"

namespace nearmiss {
namespace {

class OtherTables : public testing::TemporaryFolder {
 protected:
  /// Expects that `load` refuses a file that does not exist, and files with other content.
  template <class Load>
  void expect_refusal(const Load& load, const std::string& expected) {
    EXPECT_REFUSED(load(file("none.json")), "none.json: cannot be read");
    EXPECT_REFUSED(load(file("")), ": found a folder, expected a file");
    std::filesystem::resize_file(write("sparse.json", ""), std::uintmax_t{1} << 31);
    EXPECT_REFUSED(load(file("sparse.json")),
                   "sparse.json: found 2147483648 bytes, expected at most 1073741824");
    for (const char* text : {"", "[1]", "{\"subject\": 1}", "[{\"subject\": \"a\", \"way\": \"b\"}]",
                             "[{\"subject\": \"a\", \"flags\": \"b\"}]",
                             R"([{"subject": "a", "way": "b", "time": "1s", "seed": 1, )"
                             R"("failure": "c", "seconds": 1, "cases": 1e308}])"}) {
      write("other.json", text);
      EXPECT_REFUSED(load(file("other.json")), "expected " + expected) << text;
    }
  }
};

TEST_F(OtherTables, HuntsAreReadAsTheyAreWritten) {
  const std::vector<Hunt> hunts{{"defect:vv", "search", "60s", 7, "refuted-bound", 1.5, 42, "f:1:0"},
                                {"defect:mu", "uniform", "60s", 7}};
  write("power.json", hunts_json(hunts).dump());
  EXPECT_EQ(hunts_json(load_hunts(file("power.json"))), hunts_json(hunts));
  expect_refusal(load_hunts, "what nearmiss power --json keeps");
}

TEST_F(OtherTables, EnvironmentsAreReadAsTheyAreWritten) {
  const std::vector<Environment> environments{{"wang", "g++ 12.2.0", "-O2", "upward", 1000, 500, 0, 10, 0, 0},
                                              {"exact", "clang++ 14.0.6", "-O2 -ffast-math", "nearest", 1000,
                                               500, 3, 0, 1, 0, "false-negative f:1:0"}};
  EXPECT_EQ(environments[0].verdict(), "keeps it");
  EXPECT_EQ(environments[1].verdict(), "misses");
  write("environments.json", environments_json(environments).dump());
  EXPECT_EQ(environments_json(load_environments(file("environments.json"))), environments_json(environments));
  expect_refusal(load_environments, "the table of tools/environments");
}

}  // namespace
}  // namespace nearmiss
