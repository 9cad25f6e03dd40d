#include "fuzz/scenes/verify.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <vector>

#include "fuzz/parallel.hpp"
#include "oracle/filter/box.hpp"
#include "oracle/oracle.hpp"
#include "oracle/translation.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

/// Identifies a set of pairs by their number and the sum of their hashes. The order of the pairs does not
/// matter.
struct Fingerprint {
  std::uint64_t count = 0;
  std::uint64_t sum = 0;

  void add(const Candidate& candidate) {
    auto hash = static_cast<std::uint64_t>(candidate.kind);
    for (const int vertex : candidate.vertices) {
      hash = (hash ^ static_cast<std::uint64_t>(vertex)) * 0x9e3779b97f4a7c15U;
      hash ^= hash >> 29;
    }
    ++count;
    sum += hash;
  }
  void merge(const Fingerprint& other) {
    count += other.count;
    sum += other.sum;
  }
  bool operator==(const Fingerprint&) const = default;
};

/// Asks the oracle and the subjects about those of `pairs` that a plan leaves out. Adds to `meeting` those of
/// `pairs` whose boxes meet.
Verification verify(const AskedPairs& pairs, const Subjects& subjects, Fingerprint& meeting) {
  std::vector<Query> queries;
  std::vector<bool> expected;
  for (std::size_t i = 0; i < pairs.queries.size(); ++i) {
    const Query& query = pairs.queries[i];
    const bool meet = boxes_meet(query);
    if (meet) meeting.add(pairs.candidates[i]);
    const auto [what, collides] = meet ? fate(query) : std::pair(PairFate::boxes_apart, false);
    if (what == PairFate::asked) continue;
    queries.push_back(query);
    expected.push_back(collides);
  }
  Verification found;
  found.left_out = queries.size();
  std::vector<Decision> decisions(queries.size());
  decide(queries, decisions);
  for (std::size_t i = 0; i < queries.size(); ++i)
    found.wrong += decisions[i].collision != expected[i] || decisions[i].is_tie ? 1 : 0;
  std::vector<Verdict> verdicts(queries.size());
  for (const auto& subject : subjects) {
    subject->decide(queries, verdicts);
    std::uint64_t& spared = found.spared[subject->name()];
    for (std::size_t i = 0; i < queries.size(); ++i)
      spared += verdicts[i].hit && !decisions[i].collision ? 1 : 0;
  }
  return found;
}

}  // namespace

void Verification::merge(const Verification& other) {
  left_out += other.left_out;
  wrong += other.wrong;
  wrong_searches += other.wrong_searches;
  seconds += other.seconds;
  for (const auto& [subject, count] : other.spared) spared[subject] += count;
}

Verification verify_plan(const MovingMesh& mesh, const Subjects& subjects, int jobs,
                         const std::function<bool(double)>& progress) {
  std::atomic<bool> stop = false;
  Fingerprint found_by_tree;
  find_candidates(
      mesh, [&](const Candidate& each) { found_by_tree.add(each); },
      [&] {
        if (!progress(0)) stop = true;
        return stop.load();
      });

  Verification sum;
  Fingerprint meeting;
  const auto start = std::chrono::steady_clock::now();
  const Plan everything(mesh, LeaveOut::nothing);
  std::mutex mutex;
  std::size_t done = 0;
  in_parallel(jobs, everything.parts(), [&](std::size_t part) {
    if (stop) return;
    Verification found;
    Fingerprint meeting_here;
    everything.follow(
        part, [&](const AskedPairs& pairs) { found.merge(verify(pairs, subjects, meeting_here)); }, {},
        [&] { return stop.load(); });
    const std::lock_guard lock(mutex);
    sum.merge(found);
    meeting.merge(meeting_here);
    if (!progress(static_cast<double>(++done) / static_cast<double>(everything.parts()))) stop = true;
  });
  sum.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  sum.wrong_searches = found_by_tree == meeting || stop ? 0 : 1;
  return sum;
}

std::string describe(const Verification& verification) {
  std::string text =
      fmt::format("{}: {} pairs are left out, the oracle contradicts {} of them; {}\n",
                  verification.fine() ? "plan verified" : "THE PLAN IS WRONG",
                  with_separators(verification.left_out), with_separators(verification.wrong),
                  verification.wrong_searches == 0 ? "the tree finds all pairs whose boxes meet"
                                                   : "THE TREE FINDS OTHER PAIRS");
  for (const auto& [subject, count] : verification.spared)
    text += fmt::format("false positives of {} that the plan avoids: {}\n", subject, with_separators(count));
  return text;
}

}  // namespace nearmiss
