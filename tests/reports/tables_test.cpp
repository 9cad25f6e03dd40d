// Reports read the tables of other commands.
#include "reports/sections/power_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ccd/error.hpp"
#include "reports/sections/environment_table.hpp"
#include "tests/temporary_folder.hpp"

namespace nearmiss {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class PowerTable : public testing::TemporaryFolder {};

TEST_F(PowerTable, IsReadAsItIsWritten) {
  const std::vector<Hunt> hunts{{"defect:vv", "search", "refuted-bound", 1.5, 42, "f:1:0"},
                                {"defect:mu", "uniform"}};
  write("power.json", hunts_json(hunts).dump());
  const auto again = load_hunts(file("power.json"));
  EXPECT_EQ(hunts_json(again), hunts_json(hunts));
}

TEST_F(PowerTable, RefusesAnythingElse) {
  EXPECT_THAT([&] { load_hunts(file("none.json")); },
              ThrowsMessage<Error>(HasSubstr("none.json: cannot be read")));
  for (const char* text : {"", "[1]", "{\"subject\": 1}", "[{\"subject\": \"a\", \"way\": \"b\"}]"}) {
    write("other.json", text);
    EXPECT_THAT([&] { load_hunts(file("other.json")); },
                ThrowsMessage<Error>(HasSubstr("expected what nearmiss power --json keeps")))
        << text;
  }
}

class EnvironmentTable : public testing::TemporaryFolder {};

TEST_F(EnvironmentTable, IsReadAsItIsWritten) {
  const std::vector<Environment> environments{{"wang", "g++ 12.2.0", "-O2", "upward", 1000, 500, 0, 10, 0, 0},
                                              {"exact", "clang++ 14.0.6", "-O2 -ffast-math", "nearest", 1000,
                                               500, 3, 0, 1, 0, "false-negative f:1:0"}};
  EXPECT_EQ(environments[0].verdict(), "keeps it");
  EXPECT_EQ(environments[1].verdict(), "misses");
  write("environments.json", environments_json(environments).dump());
  EXPECT_EQ(environments_json(load_environments(file("environments.json"))), environments_json(environments));
}

TEST_F(EnvironmentTable, RefusesAnythingElse) {
  EXPECT_THAT([&] { load_environments(file("none.json")); },
              ThrowsMessage<Error>(HasSubstr("none.json: cannot be read")));
  for (const char* text : {"", "[1]", "{\"subject\": 1}", "[{\"subject\": \"a\", \"flags\": \"b\"}]"}) {
    write("other.json", text);
    EXPECT_THAT([&] { load_environments(file("other.json")); },
                ThrowsMessage<Error>(HasSubstr("expected the table of tools/environments")))
        << text;
  }
}

}  // namespace
}  // namespace nearmiss
