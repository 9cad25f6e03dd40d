// Trials: the oracle judges subjects.
#include "fuzz/trial/trial.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ccd/subjects/stopwatch.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/trial/trial_stream.hpp"
#include "oracle/oracle.hpp"
#include "reports/campaign/campaign.hpp"
#include "tests/fuzz/made_up_subjects.hpp"
#include "tests/fuzz/trials.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

using testing::falling_vertex;

using testing::batch_of;
using testing::one;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A subject that gives the same answer to all queries. An infinite `bound` means that the subject claims no
/// bound.
std::unique_ptr<Subject> told(std::string name, bool hit, double bound = infinity) {
  const Verdict verdict{hit, hit ? Stage::unspecified : Stage::none, 0};
  return std::make_unique<testing::MadeUpSubject>(
      std::move(name), [=](const Query&) { return verdict; },
      testing::Claims{.bound = bound, .claims_bound = std::isfinite(bound)});
}

/// A collision, and a vertex that stays at a distance of 1 or more.
Batch batch() {
  return batch_of("two", {falling_vertex(0.25, 0.25, 1, -1), falling_vertex(0.25, 0.25, 3, 1)});
}

Counts counts_of(const TrialResult& result) { return result.statistics.counts.begin()->second; }

TEST(Trial, RunTimesCountOnlyIfTheBatchSaysSo) {
  Batch untimed = batch();
  untimed.timed = false;
  const Subjects wang = one(make_subject("wang"));
  EXPECT_EQ(counts_of(hold_trial(wang, batch())).times.queries(), batch().queries.size());
  const Counts counts = counts_of(hold_trial(wang, untimed));
  EXPECT_EQ(counts.queries, batch().queries.size());
  EXPECT_EQ(counts.times, SubjectTimes());
}

TEST(Trial, CertifiesRecordedTruthsOnDemand) {
  Batch recorded = batch();
  const auto certified = [&](bool demanded) {
    const auto result = hold_trial({}, recorded, {.certify_truths = demanded});
    EXPECT_EQ(result.statistics.oracle_disagreements, 0);
    return result.statistics.oracle_total().certified;
  };
  recorded.truths = {true, false};
  EXPECT_EQ(certified(true), 2);
  EXPECT_EQ(certified(false), 0);
  recorded.truths = {std::nullopt, false};
  EXPECT_EQ(certified(true), 1);
  recorded.truths = {false, false};  // the first of these truths is wrong
  EXPECT_EQ(certified(true), 1);
}

TEST(Trial, ATieIsProvedUpToTheDoublesNextToIt) {
  // At t = sqrt(17) / 8, the vertex is exactly 9/4 away from the line through x1 and x2; at all other times,
  // it is farther away.
  const Query tie{.kind = Kind::vertex_triangle,
                  .x = {0,  2.265625, 0, -8, 0,  0, 8, 0, 0, 0, -20, 0,  //
                        -1, 2.265625, 0, -8, -8, 0, 8, 8, 0, 0, -20, 0},
                  .separation = 2.25};
  Batch recorded = batch_of("tie", {tie});
  for (const bool truth : {false, true}) {
    recorded.truths = {truth};
    const auto result = hold_trial({}, recorded, {.certify_truths = true});
    EXPECT_EQ(result.statistics.oracle_total().ties, 1);
    EXPECT_EQ(result.statistics.oracle_total().certified, 1);
    EXPECT_EQ(result.statistics.oracle_disagreements, 0);
    EXPECT_EQ(result.statistics.mismatches_with_recorded_truth, 0);
  }
}

TEST(Trial, EveryFindingHasASignatureThatIsCounted) {
  Subjects subjects = one(told("never", false));
  subjects.push_back(told("always", true, 0.5));
  Batch recorded = batch();
  recorded.truths = {false, std::nullopt};
  const auto result = hold_trial(subjects, recorded);
  const std::string contact = "vt simple-root inside in-face";
  const std::map<Signature, std::uint64_t> expected{
      {{Finding::What::false_negative, "never", contact}, 1},
      {{Finding::What::refuted_bound, "always", "vt unspecified"}, 1},
      {{Finding::What::truth_mismatch, "", contact}, 1}};
  EXPECT_EQ(result.statistics.seen, expected);
  for (const Finding& finding : result.findings) EXPECT_TRUE(expected.contains(signature_of(finding)));
}

TEST(Trial, AFindingHasTheClassOfItsQueryAndNotOfItsFamily) {
  const Batch degenerate_family =
      batch_of("unit-integer", {falling_vertex(0.25, 0.25, 1, -1), falling_vertex(0.25, 0, 1, -1),
                                falling_vertex(0.25, 0.25, 1e40, -1)});
  const auto result = hold_trial(one(told("never", false)), degenerate_family);
  ASSERT_EQ(result.findings.size(), 3);
  EXPECT_EQ(result.findings[0].query_class, QueryClass::ordinary);
  EXPECT_EQ(result.findings[1].query_class, QueryClass::degenerate);
  EXPECT_EQ(result.findings[2].query_class, QueryClass::extreme);
}

TEST(Trial, AMissingAnswerIsAFaultAndNoMiss) {
  Batch third = batch();
  third.queries.push_back(falling_vertex(0.25, 0.25, 4, 3));
  const auto fail_at_third = [&](const Query& query) {
    return query == third.queries[2] ? Verdict{.fault = Fault::error, .fault_code = -3} : Verdict{};
  };
  const auto result =
      hold_trial(one(std::make_unique<testing::MadeUpSubject>("choosy", fail_at_third)), third);
  EXPECT_EQ(result.statistics.faults(), 1);
  EXPECT_EQ(result.statistics.false_negatives(), 1);  // query 0 is missed
  ASSERT_EQ(result.findings.size(), 2);
  EXPECT_EQ(result.findings[1].what, Finding::What::fault);
  EXPECT_EQ(result.findings[1].signature, "vt error -3");
  EXPECT_EQ(result.findings[1].provenance, "2");
}

TEST(Trial, AnAnswerThatDependsOnWhatWasAskedBeforeIsAFault) {
  unsigned calls = 0;
  const auto forgets = [&](const Query&) {
    const bool hit = ++calls * 2654435761U >> 31 != 0;
    return Verdict{hit, hit ? Stage::unspecified : Stage::none};
  };
  const Batch many = batch_of("many", std::vector<Query>(10'000, falling_vertex(0.25, 0.25, 1, -1)));
  const TrialResult result =
      hold_trial(one(std::make_unique<testing::MadeUpSubject>("forgets", forgets)), many);
  EXPECT_GT(counts_of(result).without_answer(Fault::inconsistent), 10);
  EXPECT_EQ(result.statistics.seen.size(), 2);
  EXPECT_EQ(counts_of(hold_trial(one(make_subject("wang")), many)).faults_total(), 0);
}

// A query's number, and so its place in a batch, does not depend on the seed. Suppose that a trial chose its
// samples only by the numbers of queries. Then the samples would have the same places in the batch for every
// seed, and the answers at all other places would never be checked.
TEST(Trial, AnAnswerThatDependsOnThePlaceInABatchIsAFault) {
  const Family family = find_family("uniform-slow");
  for (const std::size_t wrong : {0, 12}) {
    std::uint64_t noticed = 0;
    for (std::uint64_t seed = 0; seed < 1500; ++seed) {
      std::vector<Query> queries;
      for (std::uint64_t i = 0; i < 16; ++i) queries.push_back(make_query(family, seed, 2 * i));
      std::size_t place = 0;
      const auto of_place = [&](const Query&) {
        const bool hit = place++ != warm_up_queries + wrong;
        return Verdict{hit, hit ? Stage::unspecified : Stage::none};
      };
      Batch batch = batch_of("uniform-slow", queries);
      batch.step = 2;
      noticed +=
          counts_of(hold_trial(one(std::make_unique<testing::MadeUpSubject>("of place", of_place)), batch))
              .without_answer(Fault::inconsistent);
    }
    EXPECT_GT(noticed, 0) << wrong;
  }
}

TEST(Trial, AFaultWhenAskedASecondTimeIsAFault) {
  const auto faults = [](Fault second) {
    std::size_t calls = 0;
    const std::vector<Query> queries(10'000, falling_vertex(0.25, 0.25, 1, -1));
    const auto answer = [&](const Query&) {
      return ++calls > queries.size() + warm_up_queries ? Verdict{.fault = second}
                                                        : Verdict::accepted(Stage::unspecified, 0.5);
    };
    return counts_of(hold_trial(one(std::make_unique<testing::MadeUpSubject>("ends", answer)),
                                batch_of("many", queries)))
        .without_answer(second);
  };
  EXPECT_GT(faults(Fault::crash), 10);
  EXPECT_EQ(faults(Fault::time), 0);
  EXPECT_EQ(faults(Fault::not_asked), 0);
}

TEST(Trial, ComparesTheMethodsOfTheOracleAsAsked) {
  const auto counts = [](const Batch& batch, const Comparison& comparison) {
    return hold_trial({}, batch, comparison).statistics.oracle_total();
  };
  const auto some_of = [](const char* family) {
    std::vector<Query> queries;
    for (std::uint64_t i = 0; i < 3000; i += 2) queries.push_back(make_query(find_family(family), 1, i));
    return batch_of(family, queries);
  };
  const OracleCounts few = counts(some_of("uniform"), {.one_in = 30});
  EXPECT_GT(few.compared, 25);
  EXPECT_LT(few.compared, 100);
  EXPECT_EQ(counts(batch(), {.one_in = 1}).compared, 2);

  constexpr std::uint64_t next_to_none = std::uint64_t{1} << 62;
  const OracleCounts far = counts(some_of("uniform"), {.one_in = next_to_none, .near_bounds = true});
  EXPECT_EQ(far.near_bounds, 0);
  EXPECT_EQ(far.compared, 0);
  const OracleCounts near = counts(some_of("planted-ulp"), {.one_in = next_to_none, .near_bounds = true});
  EXPECT_GT(near.near_bounds, 30);
  constexpr auto undecided = static_cast<std::size_t>(FilterStage::undecided);
  EXPECT_GE(near.compared, near.near_bounds);
  EXPECT_LT(near.compared, near.near_bounds + near.by_stage[undecided]);
  const OracleCounts hard = counts(some_of("planted-ulp"), {.one_in = 8});
  EXPECT_GT(hard.by_stage[undecided], 30);
  EXPECT_GE(hard.compared, hard.by_stage[undecided]);
  EXPECT_EQ(counts(some_of("planted-ulp"), {}).near_bounds, 0);  // not asked for
}

TEST(TrialStream, DecidesEverythingInOrder) {
  const Subjects subjects = one(told("never", false));
  TrialResult sum;
  Trials trials(subjects, {}, 2, Stop::never(), 0,
                [&](TrialResult&& result) { sum.merge(std::move(result)); });
  TrialStream stream(trials);
  constexpr int count = 12345;
  for (int i = 0; i < count; ++i)
    stream.add("f", falling_vertex(0.25, 0.25, 1, i % 1000 == 0 ? -1 : 0.5), std::nullopt,
               [i] { return std::to_string(i); });
  stream.finish();
  EXPECT_EQ(counts_of(sum).queries, count);
  EXPECT_EQ(counts_of(sum).times.ns_per_query(), std::nullopt) << "nothing is timed";
  const Signature missed{Finding::What::false_negative, "never", "vt simple-root inside in-face"};
  EXPECT_EQ(sum.statistics.seen, (std::map<Signature, std::uint64_t>{{missed, 13}}));
  ASSERT_EQ(sum.findings.size(), findings_kept);
  EXPECT_EQ(sum.findings[0].provenance, "0");
}

TEST(TrialStream, DecidesNothingAfterARequestToStop) {
  const Subjects subjects = one(told("never", false));
  const std::atomic<bool> requested{true};
  const Stop stop(requested);
  TrialResult sum;
  Trials trials(subjects, {}, 2, stop, 0, [&](TrialResult&& result) { sum.merge(std::move(result)); });
  TrialStream stream(trials);
  EXPECT_FALSE(stream.add("f", falling_vertex(0.25, 0.25, 1, -1), std::nullopt, [] { return ""; }));
  stream.finish();
  EXPECT_TRUE(sum.statistics.counts.empty());
}

}  // namespace
}  // namespace nearmiss
