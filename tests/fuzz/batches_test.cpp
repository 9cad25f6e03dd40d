// Large batches: how many queries a detector gets at once, in which layout it gets them, and which verdicts
// the queries of a batch get if the call fails.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "fuzz/subjects/isolation/isolated_plugin.hpp"
#include "fuzz/subjects/isolation/room.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "fuzz/trial/trial.hpp"
#include "tests/fuzz/family_queries.hpp"
#include "tests/fuzz/trials.hpp"
#include "tests/plugins.hpp"
#include "tests/refused.hpp"
#include "tests/temporary_folder.hpp"

namespace nearmiss {
namespace {

using testing::answers_of;

constexpr std::size_t batch = 100'000;  // the largest batch that most detectors in batches.c want

/// A detector of batches.c. The time limit is so long that even on a busy machine, batches are not divided.
std::unique_ptr<Subject> wanting(const std::string& detector, std::uint64_t bytes = std::uint64_t{1} << 30) {
  return make_any_subject(testing::plugin("batches") + ":" + detector, std::nullopt,
                          {.time = std::chrono::minutes(10), .bytes = bytes});
}

std::vector<Query> in_unit_cube(Kind kind, std::size_t count) {
  std::vector<Query> queries(count, Query{.kind = kind});
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < 24; ++k)
      queries[i].x[k] = std::fmod(static_cast<double>(i + 1) * std::sqrt(static_cast<double>(k + 2)), 1);
    repeat_vertices(queries[i]);
  }
  return queries;
}

/// The time of impact that the detectors `rows` and `arrays` of batches.c give.
double mean(const Query& query) {
  const std::vector<double> x = coordinate_list(query);
  double sum = 0;
  for (std::size_t k = 0; k < x.size(); ++k) sum += static_cast<double>(k + 1) * x[k];
  return sum / static_cast<double>(x.size() * (x.size() + 1) / 2);
}

TEST(Batches, AreAsLargeAsADetectorWants) {
  const auto subject = wanting("counts");
  for (const std::size_t n : {std::size_t{1}, std::size_t{2048}, std::size_t{2049}, batch, batch + 1}) {
    const auto verdicts = answers_of(*subject, std::vector<Query>(n));
    for (std::size_t i = 0; i < n; ++i)
      ASSERT_EQ(verdicts[i].fault_code, i < batch ? -static_cast<int>(std::min(n, batch)) : -1)
          << n << ' ' << i;
  }
}

TEST(Batches, AreTheSameQueriesInBothLayouts) {
  for (const char* detector : {"rows", "arrays", "small-arrays"}) {
    const auto subject = wanting(detector);
    const auto here = make_subject(testing::plugin("batches") + ":" + detector);
    for (const Kind kind : kinds)
      for (const std::size_t n : {1, 8, 9, 2048, 2049, 5'000}) {
        const auto queries = in_unit_cube(kind, n);
        std::vector<Verdict> verdicts(n);
        EXPECT_EQ(subject->decide_timed(queries, verdicts).queries, n);
        for (std::size_t i = 0; i < n; ++i)
          ASSERT_EQ(verdicts[i].time, mean(queries[i])) << detector << ' ' << i;
        EXPECT_EQ(answers_of(*subject, queries).back().time, mean(queries.back()));
        EXPECT_EQ(here->decide(queries.back()).time, mean(queries.back())) << "in this process, one by one";
      }
  }
}

TEST(Batches, ACrashIsThatOfOneQuery) {
  std::vector<Query> queries(batch);
  const std::size_t crashing = 77'777;
  queries[crashing].x[0] = 0.95;
  const auto verdicts = answers_of(*wanting("counts"), queries);
  for (std::size_t i = 0; i < batch; ++i)
    ASSERT_EQ(verdicts[i].fault, i == crashing ? Fault::crash : Fault::error) << i;
}

TEST(Batches, OnlyTheQueriesThatWereAskedTogetherWithAFailureAreAskedAgain) {
  for (const auto& [x, fault] : {std::pair(0.95, Fault::crash), std::pair(-0.95, Fault::time)}) {
    const auto subject = make_isolated_plugin(testing::plugin("batches") + ":counts-50",
                                              {.time = std::chrono::milliseconds(200)});
    std::vector<Query> queries(400);
    queries[120].x[0] = x;
    const auto verdicts = answers_of(*subject, queries);
    for (std::size_t i = 0; i < 150; ++i)
      EXPECT_EQ(verdicts[i].fault_code, i < 100 ? -50 : i != 120 ? -1 : x > 0 ? SIGSEGV : 0) << i;
    for (std::size_t i = 0; i < queries.size(); ++i)
      EXPECT_EQ(verdicts[i].fault, i == 120 ? fault : Fault::error) << i;
  }
}

TEST(Batches, HaveTheLimitOfOneQueryAndAThousandthForEachOther) {
  EXPECT_EQ(isolation::limit_of_batch(1), 1);
  EXPECT_NEAR(isolation::limit_of_batch(51), 1.05, 1e-15);
  EXPECT_EQ(isolation::limit_of_batch(batch), 10);
}

// The call with the whole batch crashes, and so does a later call with a part of the batch. But when each
// query of this part is asked by itself, no call crashes.
TEST(Batches, ACrashThatDoesNotRepeatCounts) {
  const auto verdicts = answers_of(*wanting("wearing"), std::vector<Query>(20'000));
  const auto crashes =
      std::ranges::count_if(verdicts, [](const Verdict& each) { return each.fault == Fault::crash; });
  EXPECT_GE(crashes, 1);
  EXPECT_EQ(std::ranges::count_if(verdicts, [](const Verdict& each) { return each.fault == Fault::none; }),
            20'000 - crashes);
}

TEST(Batches, TheTimeWithoutCopiesIsTheDetectorsButNotLongerThanTheWhole) {
  const auto queries = in_unit_cube(Kind::edge_edge, 100);
  std::vector<Verdict> verdicts(queries.size());
  const BatchTime forever = wanting("rows")->decide_timed(queries, verdicts);
  EXPECT_EQ(forever.kernel_nanoseconds, forever.nanoseconds);
  EXPECT_EQ(wanting("arrays")->decide_timed(queries, verdicts).kernel_nanoseconds, 0) << "it says NaN";
  EXPECT_EQ(wanting("counts")->decide_timed(queries, verdicts).kernel_nanoseconds, 0) << "it says nothing";
}

TEST(Batches, ThatDoNotFitIntoTheLimitAreRefused) {
  const auto subject = wanting("rows", std::uint64_t{8} << 20);
  const auto queries = in_unit_cube(Kind::edge_edge, batch);
  EXPECT_REFUSED(answers_of(*subject, queries),
                 "rows: a batch of 100000 queries needs 24 MiB of memory, found a limit of 8 MiB, expected a "
                 "larger --query-memory or fewer queries");
  EXPECT_TRUE(answers_of(*subject, in_unit_cube(Kind::edge_edge, 30'000)).back().hit);
}

class Room : public testing::TemporaryFolder {
 protected:
  void place(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(file(name).parent_path());
    std::ofstream(file(name)) << text;
  }
  [[nodiscard]] std::uint64_t left() const { return isolation::memory_left(file("")); }
};

TEST_F(Room, IsThatOfTheMachineOrOfTheSmallestGroup) {
  EXPECT_EQ(left(), std::numeric_limits<std::uint64_t>::max()) << "unknown";
  place("proc/meminfo", "MemTotal: 9 kB\nMemFree: 1 kB\nMemAvailable:  8 kB\n");
  EXPECT_EQ(left(), 8 * 1024);
  place("proc/self/cgroup", "3:cpu:/else\n0::/jobs/one\n");
  place("sys/fs/cgroup/jobs/one/memory.max", "max\n");
  place("sys/fs/cgroup/jobs/one/memory.current", "5000\n");
  EXPECT_EQ(left(), 8 * 1024);
  place("sys/fs/cgroup/jobs/memory.max", "7000\n");
  place("sys/fs/cgroup/jobs/memory.current", "5000\n");
  EXPECT_EQ(left(), 2000);
  place("sys/fs/cgroup/jobs/memory.stat", "anon 1\ninactive_file 400\n");
  EXPECT_EQ(left(), 2400);
  place("sys/fs/cgroup/memory.max", "100\n");
  place("sys/fs/cgroup/memory.current", "200\n");
  EXPECT_EQ(left(), 0);
}

TEST_F(Room, ThatIsLackingIsSaid) {
  EXPECT_REFUSED(isolation::expect_memory("all of it", std::uint64_t{1} << 60),
                 "all of it needs 1099511627776 MiB of memory, found ");
}

#ifdef NEARMISS_HAS_OPENCL
TEST(OpenClExample, MissesNothingAndItsTimesAreNotLate) {
  const Subjects subjects = testing::one(make_any_subject(testing::plugin("opencl") + ":optimise=0",
                                                          std::nullopt, {.time = std::chrono::minutes(10)}));
  for (const Family& family : all_families())
    for (const Kind kind : kinds_asked(family)) {
      if (!is_of_meshes(kind) || family.has_separation) continue;
      std::vector<Query> queries;
      for (const Query& query : testing::first_queries(family.name, testing::query_count(1000)))
        if (query.kind == kind) queries.push_back(query);
      const TrialResult result = hold_trial(subjects, testing::batch_of(family.name, queries));
      const Counts& counts = result.statistics.counts.begin()->second;
      EXPECT_EQ(counts.queries, queries.size());
      EXPECT_EQ(counts.faults_total(), 0) << family.name;
      EXPECT_THAT(result.findings, ::testing::IsEmpty()) << family.name;
    }
}
#endif

}  // namespace
}  // namespace nearmiss
