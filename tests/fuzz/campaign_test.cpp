// A campaign gives the same result however many threads, shards (parts that run separately) and interruptions
// it has.
#include "fuzz/trial/campaign.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <memory>
#include <string>

#include "fuzz/families/crossed.hpp"
#include "fuzz/trial/case_order.hpp"
#include "oracle/oracle.hpp"
#include "reports/campaign/campaign.hpp"
#include "tests/fuzz/made_up_subjects.hpp"

namespace nearmiss {
namespace {

struct Ran {
  Statistics statistics = {};
  std::vector<Finding> findings = {};
  int saves = 0;
};

CampaignPlan plan_of(std::uint64_t cases, int jobs, std::initializer_list<const char*> of = {}) {
  CampaignPlan plan;
  for (const char* name : of) plan.families.push_back(find_family(name));
  if (plan.families.empty()) plan.families.assign(families().begin(), families().end());
  plan.cases = cases;
  plan.jobs = jobs;
  return plan;
}

/// A campaign whose subject is wang. With `with_basic`, the subject basic is also on trial; basic misses
/// collisions, so the campaign has findings.
Ran run(const CampaignPlan& plan, bool with_basic = false, const Stop& stop = Stop::never(),
        std::unique_ptr<Subject> another = nullptr) {
  Subjects subjects;
  if (with_basic) subjects.push_back(make_subject("basic"));
  subjects.push_back(make_subject("wang"));
  if (another) subjects.push_back(std::move(another));
  Ran run{.findings = plan.findings_before};
  const CampaignProgress reached = run_campaign(
      plan, subjects,
      [&](TrialResult&& result, const CampaignProgress& /*now*/) {
        run.statistics.merge(result.statistics);
        run.findings.insert(run.findings.end(), result.findings.begin(), result.findings.end());
        for (const auto& [number, finding] : result.shrunk) run.findings.at(number) = finding;
        ++run.saves;
        return true;
      },
      stop);
  EXPECT_EQ(reached.cases, plan.before.oracle_total().queries + run.statistics.oracle_total().queries);
  EXPECT_EQ(reached.of, cases_of_shard(plan));
  EXPECT_EQ(reached.complete, plan.cases != 0 && reached.cases == reached.of);
  for (auto& [key, counts] : run.statistics.counts) counts.times = {};  // run times vary
  return run;
}

std::uint64_t queries(const Statistics& statistics, const std::string& subject, const std::string& family) {
  std::uint64_t sum = 0;
  for (const Kind kind : kinds_of_meshes) {
    const auto it = statistics.counts.find({subject, kind, family});
    if (it != statistics.counts.end()) sum += it->second.queries;
  }
  return sum;
}

TEST(Campaign, DividesTheCasesAmongTheFamiliesAndWangMissesNoneOfThem) {
  const Ran all = run(plan_of(4000, 2));
  std::uint64_t in_a_round = 0;
  for (const Family& family : families()) in_a_round += family.block_cases;
  ASSERT_GT(in_a_round, 0);
  std::uint64_t sum = 0;
  for (const Family& family : families()) {
    const auto own = queries(all.statistics, "wang", family.name);
    EXPECT_GE(own, 4000 * family.block_cases / in_a_round) << family.name;
    EXPECT_LE(own, 4000 * family.block_cases / in_a_round + 1) << family.name;
    sum += own;
  }
  EXPECT_EQ(sum, 4000);
  for (const auto& [key, counts] : all.statistics.counts) {
    EXPECT_EQ(counts.false_negatives, 0) << key.family;
    EXPECT_EQ(counts.refuted_bounds, 0) << key.family;
  }
  EXPECT_EQ(all.statistics.mismatches_with_recorded_truth, 0);
}

TEST(Campaign, ComparesAllMethodsIfAFamilyAsksForIt) {
  CampaignPlan plan = plan_of(40, 1, {"uniform", "near-underflow", "near-underflow@-1074"});
  for (Family& family : plan.families) family.block_cases = 2;
  plan.comparison.one_in = std::uint64_t{1} << 62;
  for (const auto& [key, counts] : run(plan).statistics.oracle)
    EXPECT_EQ(counts.compared, key.second == "uniform" ? 0 : counts.queries) << key.second;
}

TEST(Campaign, DoesNotDependOnTheNumberOfThreads) {
  const Ran one = run(plan_of(2000, 1), true);
  const Ran three = run(plan_of(2000, 3), true);
  EXPECT_EQ(one.statistics, three.statistics);
  EXPECT_TRUE(one.findings == three.findings);
  EXPECT_FALSE(one.findings.empty());  // misses of basic
}

TEST(Campaign, CountsEveryFailureAndKeepsAFewOfEachSignature) {
  CampaignPlan plan = plan_of(4000, 2);
  plan.shrink = false;
  const Ran all = run(plan, true);
  std::uint64_t sum = 0;
  for (const auto& [signature, times] : all.statistics.seen) sum += times;
  EXPECT_EQ(sum, all.statistics.false_negatives());
  EXPECT_LT(all.findings.size(), sum);
  std::map<Signature, std::map<QueryClass, std::size_t>> kept;
  for (const Finding& finding : all.findings) ++kept[signature_of(finding)][finding.query_class];
  EXPECT_EQ(kept.size(), all.statistics.seen.size());
  for (const auto& [signature, of_classes] : kept)
    for (const auto& [of, count] : of_classes) {
      EXPECT_LE(count, findings_kept) << signature.text << ", " << name(of);
      EXPECT_LE(count, all.statistics.seen.at(signature)) << signature.text;
    }
}

TEST(Campaign, ShardsAddUpToTheWhole) {
  CampaignPlan plan = plan_of(6000, 2, {"planted", "degenerate", "aspect@8"});
  plan.shrink = false;
  const Ran whole = run(plan, true);
  Statistics sum;
  plan.shards = 3;
  for (plan.shard = 0; plan.shard < plan.shards; ++plan.shard) sum.merge(run(plan, true).statistics);
  EXPECT_EQ(sum, whole.statistics);
}

/// A subject that never reports a collision, and sets `stop` when it has been asked `queries` queries.
std::unique_ptr<Subject> stopping(std::atomic<bool>& stop, std::uint64_t queries) {
  const auto left = std::make_shared<std::atomic<std::uint64_t>>(queries);
  return std::make_unique<testing::MadeUpSubject>("stopping", [&stop, left](const Query&) {
    if (*left == 0 || --*left == 0) stop = true;
    return Verdict{};
  });
}

TEST(Campaign, AfterAResumeIsThatOfAnUninterruptedRun) {
  CampaignPlan plan = plan_of(3000, 2, {"planted", "degenerate", "aspect@8"});
  std::atomic<bool> ignored{false};
  const auto never = [&] { return stopping(ignored, std::uint64_t{1} << 62); };
  const Ran whole = run(plan, true, Stop::never(), never());
  for (const std::uint64_t queries : {1U, 777U, 2000U}) {
    plan.before = {};
    plan.findings_before = {};
    std::atomic<bool> requested{false};
    const Ran first = run(plan, true, Stop(requested), stopping(requested, queries));
    EXPECT_LT(first.statistics.oracle_total().queries, 3000U);
    plan.before = first.statistics;
    plan.findings_before = first.findings;
    const Ran next = run(plan, true, Stop::never(), never());
    Statistics sum = first.statistics;
    sum.merge(next.statistics);
    EXPECT_EQ(sum, whole.statistics) << queries;
    EXPECT_TRUE(next.findings == whole.findings) << queries;
  }
}

TEST(Campaign, AProvenanceMakesItsQueryAgain) {
  CampaignPlan plan = plan_of(600, 2, {"aspect@8", "stiff", "planted-ulp"});
  plan.seed = 3;
  plan.shrink = false;
  const std::vector<Finding> findings = run(plan, true).findings;
  EXPECT_GT(findings.size(), 10);
  for (const Finding& finding : findings) {
    const std::string& text = finding.provenance;  // FAMILY:SEED:INDEX
    const Family family = find_family(text.substr(0, text.find(':')));
    EXPECT_EQ(make_query(family, 3, std::stoull(text.substr(text.rfind(':') + 1))), finding.query) << text;
  }
}

TEST(Campaign, CountsAnswersByTheFactorsOfCrossed) {
  CampaignPlan plan = plan_of(1500, 2, {"crossed"});
  plan.shrink = false;
  const Statistics statistics = run(plan, true).statistics;
  const auto basic = make_subject("basic");
  std::map<std::string, FactorCounts> expected;
  for (std::uint64_t i = 1; i < plan.cases; i += 2) {
    const Query query = make_query(plan.families.front(), plan.seed, i);
    const std::uint64_t hit = basic->decide(query).hit ? 1 : 0;
    const FactorCounts one = collides(query) ? FactorCounts{1, 1 - hit, 0, 0} : FactorCounts{0, 0, 1, hit};
    const crossed::Levels levels = crossed::levels_of(plan.seed, i);
    expected[""].merge(one);
    if (levels.when() == crossed::When::at_1) expected["when=at-1"].merge(one);
    if (levels.when() == crossed::When::at_1 && levels.scale() == 4)
      expected["when=at-1 scale=1e6"].merge(one);
  }
  for (const auto& [values, counts] : expected)
    EXPECT_EQ(statistics.factors.at({"basic", Kind::edge_edge, "crossed", values}), counts) << values;
  EXPECT_EQ(expected.size(), 3);
  EXPECT_GT(expected.at("when=at-1 scale=1e6").false_negatives, 0);
}

TEST(Campaign, StopsWhenTheTimeIsOver) {
  const std::atomic<bool> requested{false};
  Stop stop(requested);
  stop.limit(std::chrono::milliseconds(300));
  const Ran timed = run(plan_of(0, 2), false, stop);
  EXPECT_GT(queries(timed.statistics, "wang", "uniform"), 0);
  EXPECT_GE(timed.saves, 1);
}

}  // namespace
}  // namespace nearmiss
