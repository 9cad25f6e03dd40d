// nearmiss merge --salvage: the intact part of a damaged store.
#include "reports/store/store.hpp"
#include "tests/reports/stored.hpp"
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using testing::CommandLine;
using ::testing::HasSubstr;

class SalvageCommand : public CommandLine {};

TEST_F(SalvageCommand, SavesWhatIsIntact) {
  EXPECT_EQ(run("fuzz --cases 20000 --subject basic --db a.db").code, 1);
  const auto findings = load_campaign(file("a.db")).runs[0].findings;
  ASSERT_GT(findings.size(), 2);
  testing::Database(file("a.db")).execute("UPDATE finding SET value = value || ' ' WHERE rowid = 2");
  const std::string lost = "1 of " + std::to_string(findings.size()) + " rows of finding";
  const std::vector<std::string> words{"a.db: damaged: some rows are not as they were saved",
                                       "nearmiss merge NEW.db a.db --salvage saves ", "without " + lost};
  expect_refused("report a.db -o new", words);
  expect_refused("merge new.db a.db", words);
  expect_refused("fuzz --cases 20000 --subject basic --db a.db --resume", words);

  const Output output = expect_code(1, "merge saved.db a.db --salvage");
  EXPECT_THAT(output.out, HasSubstr("a.db: saved "));
  EXPECT_THAT(output.out, HasSubstr("rows, lost " + lost));
  EXPECT_EQ(load_campaign(file("saved.db")).runs[0].findings.size(), findings.size() - 1);
  EXPECT_EQ(report_of("saved.db", 1)["runs"][0]["salvaged"], "lost " + lost);
  expect_refused("fuzz --cases 20000 --subject basic --db saved.db --resume",
                 {"saved.db: found a run with salvaged 'lost " + lost + "', expected none"});
}

TEST_F(SalvageCommand, TakesAllOfAnIntactStore) {
  EXPECT_EQ(run("fuzz --cases 2000 --subject basic --db a.db").code, 1);
  EXPECT_THAT(run("merge b.db a.db --salvage").out, HasSubstr("rows, lost nothing"));
  EXPECT_EQ(load_campaign(file("b.db")).runs, load_campaign(file("a.db")).runs);
}

TEST_F(SalvageCommand, RefusesWhatHasNothingIntact) {
  write("text.db", "this is not a database, although it is long enough to be taken for one");
  expect_refused("merge new.db text.db --salvage", {"text.db: file is not a database"});
  expect_refused("merge new.db none.db --salvage", {"none.db: "});
}

}  // namespace
}  // namespace nearmiss
