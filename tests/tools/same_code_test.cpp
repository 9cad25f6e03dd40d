// All results of a campaign come from the same build of nearmiss and of each plug-in.
#include "reports/sha256.hpp"
#include "reports/store/store.hpp"
#include "tests/tools/background.hpp"
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::Background;
using testing::CommandLine;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

class SameCode : public CommandLine {
 protected:
  /// Replaces p.so by a plug-in. All plug-ins of this test have the same name and version.
  void install(const std::string& name) const {
    fs::copy_file(plugin(name), file("new.so"));
    fs::rename(file("new.so"), file("p.so"));
  }

  static constexpr const char* campaign = "fuzz --cases 2000 --subject ./p.so --family uniform";

  [[nodiscard]] std::string digest() const { return sha256_hex(read("p.so")); }
};

TEST_F(SameCode, AReportSaysWhichCodeRan) {
  install("example");
  EXPECT_EQ(run(std::string(campaign) + " --db a.db").code, 0);
  const json run = report_of("a.db")["runs"][0];
  EXPECT_EQ(run["plug-in boxes sha256"], digest());
  EXPECT_EQ(run["plug-in boxes version"], "1.0");
  EXPECT_EQ(run["environments"][0]["plug-in boxes"], fs::canonical(file("")).string() + "/p.so");
  EXPECT_THAT(run["commit"].get<std::string>(),
              ContainsRegex("^(unknown|[0-9a-f]{40}(-dirty.[0-9a-f]{12})?)$"));
}

TEST_F(SameCode, AnotherPluginDoesNotResume) {
  install("always");
  const std::string first = digest();
  EXPECT_EQ(run(std::string(campaign) + " --db a.db").code, 0);
  EXPECT_EQ(run(std::string(campaign) + " --db a.db --resume").code, 0);
  install("never");
  expect_refused(
      std::string(campaign) + " --db a.db --resume",
      {"a.db: found a run with plug-in always sha256 '" + first + "', expected '" + digest() + "'"});
}

TEST_F(SameCode, ShardsOfDifferentPluginsDoNotMerge) {
  install("always");
  const std::string first = digest();
  EXPECT_EQ(run(std::string(campaign) + " --shard 0/2 --db a.db").code, 0);
  install("never");
  EXPECT_EQ(run(std::string(campaign) + " --shard 1/2 --db b.db").code, 1);
  EXPECT_EQ(run(std::string(campaign) + " --seed 2 --db c.db").code, 1);
  expect_refused("merge new.db a.db b.db", {"b.db: found plug-in always sha256 '" + digest() +
                                            "', expected '" + first + "' as in a.db"});
  expect_refused("report a.db b.db -o new", {"b.db: found plug-in always sha256"});
  EXPECT_EQ(run("merge new.db a.db c.db").code, 1);  // different nights
  EXPECT_EQ(load_campaign(file("new.db")).runs.size(), 2);
}

TEST_F(SameCode, AnotherNearmissDoesNotResume) {
  EXPECT_EQ(run("fuzz --cases 100 --db a.db").code, 0);
  for (const char* fact : {"commit", "version"}) {
    Campaign other = load_campaign(file("a.db"));
    other.runs[0].info[fact] = "another";
    fs::remove(file("b.db"));
    write_campaign(other, file("b.db"));
    expect_refused("fuzz --cases 100 --db b.db --resume",
                   {std::string("b.db: found a run with ") + fact + " 'another', expected '"});
    expect_refused("merge new.db a.db b.db", {std::string("b.db: found ") + fact + " 'another', expected '"});
  }
}

TEST_F(SameCode, APluginThatIsReplacedEndsTheCampaign) {
  install("example");
  const std::string endless = "fuzz --time 24h --subject ./p.so --family uniform --db a.db";
  Background process(file(""), endless);
  ASSERT_TRUE(wait_for_a_save(process));
  install("always");
  (void)process.wait_until([] { return false; });
  EXPECT_EQ(process.code(), 2);
  const std::string error = read("error.txt");
  EXPECT_THAT(error,
              HasSubstr("nearmiss: ./p.so: the plug-in was changed while it was on trial: found sha256 " +
                        digest() + ", expected the file with sha256 "));
  EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << error;

  const std::uint64_t cases = report_of("a.db")["runs"][0]["cases_done"];
  EXPECT_GT(cases, 0);
  expect_refused(endless + " --resume", {"a.db: found a run with plug-in boxes sha256 '"});
  install("example");
  EXPECT_EQ(run("fuzz --time 1s --subject ./p.so --family uniform --db a.db --resume").code, 0);
}

}  // namespace
}  // namespace nearmiss
