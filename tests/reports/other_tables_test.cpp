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

TEST_F(OtherTables, AnEnvironmentGetsItsVerdict) {
  const auto row = [](int missed, int faults, const std::string& first) {
    return R"({"subject":"wang","compiler":"g++ 12.2.0","flags":"-O2","mode":"upward","queries":1000,)"
           R"("collisions":500,"missed":)" +
           std::to_string(missed) + R"(,"false_positives":10,"refuted_bounds":1,"faults":)" +
           std::to_string(faults) + "%" + R"(,"first":)" + first + "}";
  };
  std::string expected = "[" + row(0, 0, "null") + "," + row(3, 1, R"("false-negative f:1:0")") + "," +
                         row(0, 1, R"("fault f:1:1")") + "]";
  std::string written = expected;
  for (const char* verdict : {"keeps it", "misses", "gives no answer"}) {
    expected.replace(expected.find('%'), 1, R"(,"verdict":")" + std::string(verdict) + '"');
    written.erase(written.find('%'), 1);
  }
  write("environments.json", written);
  EXPECT_EQ(load_environments(file("environments.json")), expected);
  expect_refusal(load_environments, "the table of tools/environments");
}

}  // namespace
}  // namespace nearmiss
