// Tests that the merged shards (parts) of a run give the same result as a run on one machine.
#include "reports/campaign/campaign.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

#include "reports/report.hpp"
#include "reports/text/json.hpp"
#include "tests/queries.hpp"
#include "tests/refused.hpp"

namespace nearmiss {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::StartsWith;

const RunInfo info{{"command", "fuzz"}, {"seed", "1"}};

Finding finding(std::uint64_t round, const std::string& provenance, double shrunk,
                const std::string& signature) {
  Finding made;
  made.subject = "basic";
  made.provenance = provenance;
  made.signature = signature;
  made.place = round;
  made.shrunk = testing::falling_edge(shrunk, -1);
  return made;
}

/// Shard (part) `shard` of three, which divide the rounds 0 to 9 of a run among them. Each round has a
/// finding with the signature (way to fail) "s"; rounds from 5 on also have a finding with the signature "t".
Campaign shard_of_three(std::uint64_t shard) {
  Run run{info, {{.index = shard, .count = 3, .complete = true}}, {}};
  for (std::uint64_t round = shard; round < 10; round += 3)
    for (const char* signature : {"s", "t"})
      if (round >= 5 || *signature == 's')
        run.findings.push_back(finding(round, std::to_string(round), static_cast<double>(round), signature));
  Campaign campaign{{run}, {}};
  campaign.statistics.oracle_disagreements = shard + 1;
  return campaign;
}

Campaign merged(const std::vector<std::uint64_t>& shards) {
  std::vector<Campaign> campaigns;
  std::vector<std::string> names;
  for (const auto shard : shards) {
    campaigns.push_back(shard_of_three(shard));
    names.push_back(std::to_string(shard) + ".db");
  }
  return merge_campaigns(campaigns, names);
}

Campaign merge(const Campaign& one, const Campaign& other) {
  return merge_campaigns(std::vector{one, other}, std::vector<std::string>{"a.db", "b.db"});
}

TEST(Campaign, ARunBeganWithItsFirstShard) {
  nearmiss::Run run{info, {}, {}};
  for (const char* started : {"2026-02-02T00:00:00Z", "2026-02-01T00:00:00Z", "2026-02-03T00:00:00Z"})
    run.shards.push_back(
        {.index = run.shards.size(), .count = 3, .cases = 10, .complete = true, .started = started});
  const auto json = runs_json({run})[0];
  EXPECT_EQ(json["started"], "2026-02-01T00:00:00Z");
  EXPECT_EQ(json["cases_done"], 30);
}

// The unshrunk finding has a query without coincident vertices, which is less exotic than the query of the
// shrunk finding. Still, the shrunk finding comes first.
TEST(Campaign, ShowsShrunkFindingsOfAClassFirst) {
  Campaign campaign{{{info, {{}}, {}}}, {}};
  for (const bool is_shrunk : {false, true}) {
    Finding each = finding(0, is_shrunk ? "shrunk" : "whole", 0, "s");
    if (is_shrunk) each.shrunk = Query{.kind = Kind::edge_edge};
    each.query_class = QueryClass::degenerate;
    each.is_shrunk = is_shrunk;
    campaign.runs.front().findings.push_back(each);
  }
  const std::vector<Finding> shown = campaign.findings();
  ASSERT_EQ(shown.size(), 2);
  EXPECT_LT(exoticness(shown[1].shrunk, QueryClass::degenerate),
            exoticness(shown[0].shrunk, QueryClass::degenerate));
  EXPECT_EQ(shown.front().provenance, "shrunk");
}

TEST(Campaign, ShowsSlowQueriesLast) {
  Campaign campaign{{{info, {{}}, {}}}, {}};
  for (const bool is_slow : {true, false}) {
    Finding each = finding(0, "", 0, is_slow ? "ee time" : "s");
    if (is_slow) each.what = Finding::What::fault;
    each.query_class = is_slow ? QueryClass::ordinary : QueryClass::extreme;
    campaign.runs.front().findings.push_back(each);
  }
  EXPECT_EQ(campaign.findings().front().signature, "s");
}

TEST(Campaign, AllShardsGiveTheWholeInAnyOrder) {
  const Campaign whole = merged({0, 1, 2});
  ASSERT_EQ(whole.runs.size(), 1);
  std::vector<std::string> kept;
  for (const Finding& each : whole.runs.front().findings) kept.push_back(each.signature + each.provenance);
  EXPECT_EQ(kept, (std::vector<std::string>{"s0", "s1", "s2", "t5", "t6", "t7"}));
  EXPECT_EQ(whole.statistics.oracle_disagreements, 6);
  std::vector<std::uint64_t> order{0, 1, 2};
  while (std::next_permutation(order.begin(), order.end())) EXPECT_EQ(merged(order).runs, whole.runs);
  EXPECT_EQ(merge(merged({2, 0}), shard_of_three(1)).runs, whole.runs);
}

TEST(Campaign, SaysWhichShardsAreMissing) {
  EXPECT_EQ(missing_shards(merged({0, 1, 2}).runs.front()), "");
  EXPECT_EQ(missing_shards(merged({1}).runs.front()), "shards 0, 2 of 3 are missing");
  EXPECT_EQ(missing_shards({{}, {{.index = 0, .count = 2}}, {}}),
            "shards 1 of 2 are missing, shards 0 of 2 are not complete (stopped after 0 cases)");
  EXPECT_THAT(
      missing_shards({{}, {{.index = 1, .count = ~std::uint64_t{0}, .complete = true}}, {}}),
      AllOf(StartsWith("shards 0, 2, 3, "), EndsWith(", 20, ... of 18446744073709551615 are missing")));
}

TEST(Campaign, SaysHowFarARunHasCome) {
  const auto said = [](const char* cases) {
    return missing_shards({{{"cases", cases}}, {{.cases = 1200}}, {}});
  };
  EXPECT_EQ(said("5000"), "stopped after 1,200 of 5000 cases");
  EXPECT_EQ(said("1200"), "stopped before all findings were shrunk");
  EXPECT_EQ(said("until the time is over"), "stopped after 1,200 cases, before its time was over");
  EXPECT_EQ(missing_shards({{}, {{.cases = 1200}}, {}}), "stopped after 1,200 cases");
  EXPECT_EQ(missing_shards(
                {{}, {{.index = 0, .count = 2, .cases = 7}, {.index = 1, .count = 2, .cases = 1200}}, {}}),
            "shards 0, 1 of 2 are not complete (stopped after 7 and 1,200 cases)");
}

TEST(Campaign, AShardIsTakenOnce) {
  EXPECT_ERROR(merged({0, 1, 0}), "0.db and 0.db: both have shard 0/3 of the run with command fuzz, seed 1");
}

TEST(Campaign, ARunIsCutInOneWay) {
  std::vector campaigns{shard_of_three(0), shard_of_three(1)};
  campaigns[1].runs[0].shards[0].count = 4;
  EXPECT_REFUSED(merge(campaigns[0], campaigns[1]), "b.db: found a shard of 4, and one of 3 in a.db");
}

TEST(Campaign, RunsThatDifferStandSideBySide) {
  std::vector campaigns{shard_of_three(0), shard_of_three(0)};
  campaigns[1].runs[0].info["seed"] = "0";
  const Campaign both = merge(campaigns[0], campaigns[1]);
  ASSERT_EQ(both.runs.size(), 2);
  EXPECT_EQ(both.runs[0].info.at("seed"), "0");
}

TEST(Campaign, ANameStandsForOneSubject) {
  std::vector campaigns{shard_of_three(0), shard_of_three(0)};
  campaigns[1].runs[0].info["seed"] = "0";
  campaigns[0].runs[0].info["subject x"] = campaigns[1].runs[0].info["subject x"] = "x=wang";
  EXPECT_EQ(merge(campaigns[0], campaigns[1]).runs.size(), 2);
  campaigns[1].runs[0].info["subject x"] = "x=basic";
  EXPECT_ERROR(merge(campaigns[0], campaigns[1]),
               "b.db: found the name 'x' for x=basic, but for x=wang in a.db, expected different names");
  campaigns[1].runs[0].info.erase("subject x");
  campaigns[1].runs[0].info["plug-in x sha256"] = "0";
  EXPECT_REFUSED(merge(campaigns[0], campaigns[1]), "for the plug-in x, but for x=wang in a.db");
  campaigns[0].runs[0].info.erase("subject x");
  campaigns[0].runs[0].info["plug-in x sha256"] = "1";  // another version
  EXPECT_EQ(merge(campaigns[0], campaigns[1]).runs.size(), 2);
  campaigns[0].runs[0].info["plug-in x detector"] = "boxes";
  EXPECT_REFUSED(merge(campaigns[0], campaigns[1]), "for the plug-in x, but for the plug-in boxes in a.db");
  for (Campaign& each : campaigns) each.runs[0].info["plug-in boxes:t=0 sha256"] = "1";
  campaigns[0].runs[0].info["plug-in boxes:t=0 detector"] = "boxes";  // for --subject boxes=...
  campaigns[1].runs[0].info["plug-in x detector"] = "boxes";
  campaigns[1].runs[0].info["plug-in sha256"] = "1";  // names no plug-in
  EXPECT_EQ(merge(campaigns[0], campaigns[1]).runs.size(), 2);
}

/// A campaign with one run of seed 3. The run asked the subject of `key` 10 queries of the kind and the
/// family of `key`.
Campaign asked(const std::string& families, const std::string& cases, const CountsKey& key) {
  const RunInfo facts{{"command", "fuzz"}, {"seed", "3"}, {"families", families}, {"cases", cases}};
  Campaign campaign{{{facts, {{.index = 0, .complete = true}}, {}}}, {}};
  campaign.statistics.counts[key].queries = 10;
  return campaign;
}

TEST(Campaign, TheSameQueriesDoNotCountTwice) {
  const CountsKey uniform{"wang", Kind::edge_edge, "uniform"};
  const Campaign some = asked("uniform", "300", uniform);
  for (const char* families : {"uniform", "all", "needle,uniform", "uniform, search"})
    EXPECT_ERROR(
        merge(some, asked(families, "301", uniform)),
        "b.db: found queries of uniform with seed 3 that wang was asked in a.db, too, expected another seed");
  const CountsKey searched{"wang", Kind::edge_edge, "search-miss-wang"};
  EXPECT_REFUSED(merge(asked("uniform, search", "1", searched), asked("needle, search", "1", searched)),
                 "queries of search-miss-wang with seed 3");
  for (const CountsKey& other :
       {CountsKey{"basic", Kind::edge_edge, "uniform"}, CountsKey{"wang", Kind::vertex_triangle, "uniform"},
        CountsKey{"wang", Kind::edge_edge, "uniform~0.5"}, CountsKey{"wang", Kind::edge_edge, "uniform@1"}})
    EXPECT_EQ(merge(some, asked("uniform", "301", other)).runs.size(), 2) << other.family;
  // This run asked only the family `needle`.
  EXPECT_EQ(merge(some, asked("needle", "301", uniform)).runs.size(), 2);
  Campaign other_seed = asked("uniform", "301", uniform);
  other_seed.runs[0].info["seed"] = "4";
  EXPECT_EQ(merge(some, other_seed).runs.size(), 2);
  Campaign shard = some;
  shard.runs[0].shards = {{.index = 1, .count = 2}};
  Campaign first = some;
  first.runs[0].shards[0].count = 2;
  EXPECT_EQ(merge(first, shard).runs.size(), 1);
}

TEST(Campaign, TheSameMeshIsTheSameQueries) {
  for (const std::string family : {"mesh", "mesh~0.5"}) {
    const CountsKey mesh{"wang", Kind::edge_edge, family};
    std::vector campaigns{asked("mesh", "1", mesh), asked("mesh", "2", mesh)};
    EXPECT_REFUSED(merge(campaigns[0], campaigns[1]), "queries of mesh");
    campaigns[0].runs[0].info["scene"] = "start.obj end.obj";
    EXPECT_EQ(merge(campaigns[0], campaigns[1]).runs.size(), 2);
  }
}

// A merged store still has the facts of each run, which say what the run asked.
TEST(Campaign, AMergedStoreIsMergedAgain) {
  const auto run = [](const std::string& subject, const std::string& given, const std::string& seed,
                      Kind kind) {
    Campaign made = asked("uniform", "1", {subject, kind, "uniform"});
    made.runs[0].info["seed"] = seed;
    made.runs[0].info["subjects"] = given;
    made.runs[0].info["kinds"] = short_name(kind);
    return made;
  };
  const Campaign one = run("wang", "wang", "1", Kind::edge_edge);
  const Campaign other = run("x", "exact,x=basic", "1", Kind::edge_edge);
  EXPECT_EQ(merge(merge(one, run("x", "x=basic", "2", Kind::edge_edge)), other).runs.size(), 3);
  EXPECT_EQ(merge(merge(one, run("wang", "wang", "2", Kind::vertex_edge)),
                  run("wang", "wang", "1", Kind::vertex_edge))
                .runs.size(),
            3);
  EXPECT_REFUSED(merge(merge(one, other), run("x", "x=basic", "1", Kind::edge_edge)), "seed 1 that x was");
  EXPECT_REFUSED(merge(run("boxes", "./boxes.so", "1", Kind::edge_edge),
                       run("boxes", "y=/a=b.so,./boxes.so", "1", Kind::edge_edge)),
                 "seed 1 that boxes was");
}

TEST(Campaign, TheSameSeparationMayBeWrittenDifferently) {
  const auto with = [](const std::string& cases, const std::string& separation) {
    return asked("uniform", cases, {"wang", Kind::edge_edge, "uniform~" + separation});
  };
  EXPECT_REFUSED(merge(with("1", "0.1"), with("2", "0.10")), "of uniform~0.1");
  EXPECT_EQ(merge(with("1", "0.1"), with("2", "drawn")).runs.size(), 2);
}

TEST(Campaign, CountsThatDoNotFitAreRefused) {
  const CountsKey key{"wang", Kind::edge_edge, "cases/"};
  std::vector campaigns{asked("uniform", "1", key), asked("uniform", "2", key)};
  for (Campaign& each : campaigns) each.statistics.counts[key].queries = largest_count / 2 + 1;
  EXPECT_ERROR(merge(campaigns[0], campaigns[1]),
               "found counts that add up to more than 2^60, expected fewer queries");
}

/// Shards 0 and 1 of a run, with different values of a fact about the run.
std::vector<Campaign> shards_that_differ_in(const std::string& fact) {
  std::vector campaigns{shard_of_three(0), shard_of_three(1)};
  campaigns[0].runs[0].info[fact] = "a";
  campaigns[1].runs[0].info[fact] = "b";
  return campaigns;
}

TEST(Campaign, ShardsOfDifferentCodeAreRefused) {
  for (const std::string fact : {"version", "commit", "plug-in boxes sha256", "plug-in boxes version"}) {
    auto campaigns = shards_that_differ_in(fact);
    EXPECT_ERROR(
        merge(campaigns[0], campaigns[1]),
        "b.db: found " + fact + " 'b', expected 'a' as in a.db, for the run with command fuzz, seed 1");
    campaigns[1].runs[0].info["seed"] = "2";  // a run of another night
    EXPECT_EQ(merge(campaigns[0], campaigns[1]).runs.size(), 2);
    campaigns[1] = campaigns[0];
    campaigns[1].runs[0].shards[0].index = 1;
    EXPECT_EQ(merge(campaigns[0], campaigns[1]).runs.size(), 1);
  }
}

TEST(Campaign, ARunWithoutAFactOfItsCodeIsRefused) {
  std::vector campaigns{shard_of_three(0), shard_of_three(1)};
  campaigns[1].runs[0].info["plug-in boxes sha256"] = "b";
  EXPECT_REFUSED(merge(campaigns[0], campaigns[1]),
                 "b.db: found plug-in boxes sha256 'b', expected '' as in a.db");
}

TEST(Campaign, ShowsOrdinaryQueriesFirstThenFrequentFailuresThenSimpleQueries) {
  Campaign campaign{{{info, {}, {}}}, {}};
  auto& findings = campaign.runs.front().findings;
  const auto add = [&](const std::string& name, const std::string& signature, QueryClass of, double number) {
    findings.push_back(finding(findings.size(), name, number, signature));
    findings.back().query_class = of;
    if (number == 0) findings.back().shrunk = {};
    ++campaign.statistics.seen[signature_of(findings.back())];
  };
  add("zeros", "a", QueryClass::degenerate, 0);
  add("extreme", "a", QueryClass::extreme, 1);
  add("degenerate", "a", QueryClass::degenerate, 1);
  add("awkward", "a", QueryClass::ordinary, 0.1);
  add("simple", "a", QueryClass::ordinary, 2);
  add("rare", "b", QueryClass::ordinary, 1);
  findings.push_back(finding(9, "oracle", 1, "c"));
  findings.back().subject = "";
  std::vector<std::string> shown;
  for (const Finding& each : campaign.findings()) shown.push_back(each.provenance);
  EXPECT_EQ(shown, (std::vector<std::string>{"oracle", "simple", "awkward", "rare", "degenerate", "zeros",
                                             "extreme"}));
}

TEST(Campaign, ShowsOneOfThoseThatAreShrunkToTheSame) {
  const Campaign campaign{{{info,
                            {},
                            {finding(1, "a", 1, "t"), finding(2, "b", 1, "t"), finding(2, "c", 1, "s"),
                             finding(3, "d", 2, "t")}}},
                          {}};
  std::vector<std::string> shown;
  for (const Finding& each : campaign.findings()) shown.push_back(each.provenance);
  EXPECT_EQ(shown, (std::vector<std::string>{"c", "a", "d"}));
}

}  // namespace
}  // namespace nearmiss
