// Ways to fail that the baseline has and a later campaign does not have.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "reports/sections/baseline.hpp"
#include "reports/sections/headline.hpp"
#include "reports/text/json.hpp"
#include "tests/reports/campaigns.hpp"

namespace nearmiss {
namespace {

using ::nearmiss::testing::campaign;
using ::nearmiss::testing::counts;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Seen = std::map<Signature, std::uint64_t>;

const auto missed = Finding::What::false_negative;
const CountsKey key{"mine", Kind::edge_edge, "uniform"};
const Signature inside{missed, "mine", "ee inside"};
const Signature on_edge{missed, "mine", "ee on-edge"};

/// A campaign of a plug-in, which began at this date.
Campaign night(const std::string& date, Seen seen, const std::string& version = "1",
               const std::string& sha256 = "a", std::uint64_t queries = 200000) {
  Campaign made = campaign(date, {{key, counts(queries, queries / 2, 0, 0)}});
  made.runs[0].shards[0].started = date;
  made.runs[0].info["plug-in mine version"] = version;
  made.runs[0].info["plug-in mine sha256"] = sha256 + "0123456789abcdef";
  made.statistics.seen = std::move(seen);
  return made;
}

TEST(Gone, IsWhatChanceWouldHardlyHide) {
  const Changes found = changes(night("2", {{on_edge, 20}}), night("1", {{inside, 40}, {on_edge, 20}}));
  EXPECT_THAT(found.gone_signatures, ElementsAre(inside));
  EXPECT_EQ(describe(found),
            "lasting: 1 way to fail of mine, the oldest first seen 1 (version 1)\n"
            "gone: false-negative of mine, ee inside, first seen 1 (version 1), last seen 1 (version 1)\n");
  EXPECT_THAT(headline({}, found).text, HasSubstr("1 way to fail is gone"));
  const Changes chance = changes(night("2", {{on_edge, 20}}), night("1", {{inside, 4}, {on_edge, 20}}));
  EXPECT_THAT(chance.gone_signatures, IsEmpty());
  EXPECT_THAT(chance.unrepeated_signatures, ElementsAre(inside));
}

// Chance could explain the absence of each single failure, but hardly that of all failures.
TEST(Gone, AreTheRareFailuresOfASubjectThatFailsNoMore) {
  Seen rare;
  for (int i = 0; i < 30; ++i) rare[{missed, "mine", "way " + std::to_string(i)}] = 1;
  EXPECT_EQ(changes(night("2", {}), night("1", rare)).gone_signatures.size(), 30);
  EXPECT_THAT(changes(night("2", {{inside, 1}}), night("1", rare)).gone_signatures, IsEmpty());
}

// A time limit ended the later campaign. It asked twice as many queries of the signature's family as the
// earlier campaign, and as many of the other family.
TEST(New, ASignatureIsOnlyIfItsFamilyDoesNotExplainIt) {
  const auto night_of = [](const std::string& date, std::uint64_t queries, std::uint64_t seen) {
    Campaign made = night(date, {{inside, seen}});
    made.statistics.counts[{"mine", Kind::edge_edge, "parallel"}] = counts(queries, queries / 2, 0, 0);
    return made;
  };
  const Campaign before = night_of("1", 1000, 100);
  EXPECT_THAT(changes(night_of("2", 2000, 200), before).new_signatures, IsEmpty());
  EXPECT_THAT(changes(night_of("2", 1000, 200), before).new_signatures, ElementsAre(inside));
}

TEST(Gone, NeedsTheQueriesOfEveryFamily) {
  const Campaign before = night("1", {{inside, 40}});
  EXPECT_THAT(changes(night("2", {}, "1", "a", 20000), before).gone_signatures, IsEmpty());
  Campaign other = night("2", {});
  other.statistics.counts = {{{"mine", Kind::edge_edge, "parallel"}, counts(200000, 100000, 0, 0)}};
  EXPECT_THAT(changes(other, before).gone_signatures, IsEmpty());
  Campaign crashes = night("2", {});
  crashes.statistics.counts[key].faults[static_cast<std::size_t>(Fault::crash)] = 100000;
  crashes.statistics.counts[key].collisions = 0;
  EXPECT_THAT(changes(crashes, before).gone_signatures, ElementsAre(inside));
  crashes.statistics.counts[key].faults[static_cast<std::size_t>(Fault::crash)] = 199000;
  EXPECT_THAT(changes(crashes, before).gone_signatures, IsEmpty());
}

// The signatures were seen in cases, and the later campaign replays fewer of them.
TEST(Gone, DoesNotCountFailuresInCases) {
  const Signature late{Finding::What::late, "mine", "ee inside"};
  const Signature crash{Finding::What::fault, "mine", "ee crash"};
  Campaign before = night("1", {{inside, 40}, {late, 40}, {crash, 40}});
  Counts& cases = before.statistics.counts[{"mine", Kind::edge_edge, "planar/"}];
  cases = counts(50, 50, 38, 0);
  cases.late = 38;
  cases.faults[static_cast<std::size_t>(Fault::crash)] = 38;
  EXPECT_THAT(changes(night("2", {}), before).gone_signatures, IsEmpty());
  cases.faults = {};
  cases.faults[static_cast<std::size_t>(Fault::not_asked)] = 40;
  EXPECT_THAT(changes(night("2", {}), before).gone_signatures, ElementsAre(crash));
}

TEST(Gone, IsFixedIfTheCodeHasChanged) {
  const std::vector before{night("1", {{inside, 40}}, "1", "a"), night("2", {{inside, 30}}, "2", "b")};
  const auto text = [&](const std::string& version, const std::string& sha256) {
    return describe(changes(night("3", {}, version, sha256), before));
  };
  const std::string seen =
      ": false-negative of mine, ee inside, first seen 1 (version 1), last seen 2 (version 2)\n";
  EXPECT_EQ(text("3", "c"), "fixed in version 3" + seen);
  EXPECT_EQ(text("2", "c"), "fixed since sha256 c0123456789a" + seen);
  EXPECT_EQ(text("2", "b"), "gone" + seen);
  const auto json = changes_json(changes(night("3", {}, "3", "c"), before));
  EXPECT_EQ(json["gone_signatures"][0]["fixed"], "in version 3");
  EXPECT_EQ(json["gone_signatures"][0]["first_code"], "version 1");
  EXPECT_EQ(json["gone_signatures"][0]["last_code"], "version 2");
  // The first later code without the signature has the fix, not the code of this campaign.
  auto nights = before;
  nights.push_back(night("3", {}, "2", "b"));
  nights.push_back(night("4", {}, "3", "c"));
  EXPECT_THAT(describe(changes(night("5", {}, "4", "d"), nights)), HasSubstr("fixed in version 3: "));
}

TEST(Gone, OfABuiltInSubjectIsFixedInAVersionOfNearmiss) {
  Campaign before = night("1", {{inside, 40}});
  before.runs[0].info = {{"version", "0.1"}, {"commit", "abc"}};
  Campaign now = night("2", {});
  now.runs[0].info = {{"version", "0.1"}, {"commit", "def"}};
  EXPECT_THAT(describe(changes(now, before)), HasSubstr("fixed since commit def: "));
  EXPECT_EQ(code_of(now, "mine"), (SubjectCode{"0.1", "commit def"}));
}

}  // namespace
}  // namespace nearmiss
