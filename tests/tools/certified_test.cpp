// Recorded truths and findings have certificates, as a user sees them.
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using testing::CommandLine;
using ::testing::HasSubstr;

class Certified : public CommandLine {
 protected:
  /// The output of check.py for certificates, one a line.
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
    const std::string trial = "--family uniform,parallel --cases 1000 -q --subject " + subjects;
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
