// nearmiss paper, as a user sees it.
#include <fstream>
#include <set>
#include <sstream>

#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using testing::CommandLine;
using ::testing::HasSubstr;
using ::testing::Not;

class Paper : public CommandLine {
 protected:
  /// The result for one claim.
  [[nodiscard]] json claim(const std::string& name) const {
    expect_code(0, "paper " + name + " --json new.json");
    json all = read_json("new.json").at("claims");
    EXPECT_EQ(all.size(), 1U) << name;
    EXPECT_EQ(all[0].at("name"), name);
    return all[0];
  }
};

TEST_F(Paper, AClaimIsMeasuredByTheCommandThatItNames) {
  const json constants = claim("constants");
  EXPECT_EQ(constants["commands"], json::parse(R"(["nearmiss audit"])"));
  EXPECT_EQ(constants["verdict"], "holds with a condition");
  EXPECT_THAT(constants["measured"], HasSubstr("too small where end points of edges are beyond B"));
  const json audit = json::parse(expect_code(0, "audit --json -").out);
  const auto too_small =
      std::ranges::count_if(audit["constants"], [](const json& row) { return row["too_small"] == true; });
  EXPECT_THAT(constants["measured"], HasSubstr("and " + std::to_string(too_small) + " are too small"));
}

TEST_F(Paper, AClaimWithoutACommandIsMeasuredByItsOwn) {
  const json planes = claim("planes");
  EXPECT_EQ(planes["commands"], json::parse(R"(["nearmiss paper planes"])"));
  EXPECT_EQ(planes["verdict"], "holds");
  EXPECT_THAT(planes["measured"], HasSubstr("together 0.2"));
}

TEST_F(Paper, AClaimThatDoesNotHoldIsNamed) {
  const json order = claim("order");  // ε^¼, where the introduction has ε^⅓
  EXPECT_EQ(order["verdict"], "does not hold");
  EXPECT_THAT(order["measured"], HasSubstr("ε^0.250"));
}

TEST_F(Paper, ClaimsThatNeedOtherMachinesAreNotMeasured) {
  EXPECT_EQ(claim("gpu")["verdict"], "cannot be measured here");
}

TEST_F(Paper, NothingElseIsPrintedWithTheJson) {
  const Output output = expect_code(0, "paper constants tolerances --quiet --json -");
  EXPECT_EQ(json::parse(output.out)["claims"].size(), 2U);
  EXPECT_THAT(output.error, Not(HasSubstr("constant  ")));  // the table of nearmiss audit
}

TEST_F(Paper, AnUnknownClaimIsRefused) { expect_refused("paper nothing", {"'nothing'", "constants"}); }

TEST_F(Paper, AReportShowsTheClaims) {
  expect_code(0, "paper gpu --json paper.json");
  expect_code(0, "fuzz --cases 4 --db a.db");
  EXPECT_EQ(report_of("a.db --paper paper.json")["paper"], read_json("paper.json"));
  for (const char* other : {R"({"claims": 1})", R"([])", R"({"claims": [1]})", R"({"claims": [], "run": 1})",
                            R"({"claims": [{"name": null}], "run": {}})"}) {
    write("other.json", other);
    EXPECT_THAT(expect_code(2, "report a.db -o report --paper other.json").error,
                HasSubstr("expected what nearmiss paper --json keeps"))
        << other;
  }
  json paper = read_json("paper.json");
  paper["claims"][0]["verdict"] = "maybe";
  write("other.json", paper.dump());
  EXPECT_THAT(expect_code(2, "report a.db -o report --paper other.json").error,
              HasSubstr("the verdict 'maybe'"));
}

// The table in ccd/README.md has a row for each claim, with what it says.
TEST_F(Paper, EachClaimIsInTheTable) {
  std::ifstream file(std::filesystem::path(NEARMISS_README).parent_path() / "ccd/README.md");
  const std::string readme((std::istreambuf_iterator<char>(file)), {});
  std::istringstream listed(expect_code(0, "paper --list").out);
  int claims = 0;
  for (std::string line; std::getline(listed, line);) {
    if (line.starts_with(" ")) continue;  // a command
    ++claims;
    const auto name = line.substr(0, line.find(' '));
    const auto says = line.substr(line.find("): ") + 3);
    EXPECT_THAT(readme, HasSubstr("| " + name + " |")) << line;
    EXPECT_THAT(readme, HasSubstr("| " + says + " |")) << line;
  }
  EXPECT_GT(claims, 20);
}

}  // namespace
}  // namespace nearmiss
