#include "fuzz/scenes/verify.hpp"

#include <fmt/format.h>

#include <atomic>
#include <mutex>
#include <vector>

#include "fuzz/parallel.hpp"
#include "oracle/box.hpp"
#include "oracle/oracle.hpp"
#include "oracle/translation.hpp"
#include "reports/summary.hpp"

namespace nearmiss {

namespace {

/// A set of pairs, whatever their order: how many, and the sum of a hash of each.
struct Fingerprint {
  std::uint64_t count = 0;
  std::uint64_t sum = 0;

  void add(const Candidate& candidate) {
    std::uint64_t hash = 0;
    for (const int vertex : candidate.vertices) {
      hash = (hash ^ static_cast<std::uint64_t>(vertex)) * 0x9e3779b97f4a7c15U;
      hash ^= hash >> 29;
    }
    ++count;
    sum += hash;
  }
  bool operator==(const Fingerprint&) const = default;
};

/// Pairs that are left out, decided a batch at a time.
class Check {
 public:
  explicit Check(const Subjects& subjects) : subjects_(subjects) {}

  void take(const Query& query) {
    const bool boxes = boxes_meet(query);
    std::optional<bool> answer;
    if (boxes && relative_motion(query) != RelativeMotion::other) answer = meets_by_translation(query);
    if (boxes && !answer) return;  // it is asked
    queries_.push_back(query);
    expected_.push_back(answer.value_or(false));
    if (queries_.size() == 4096) decide_all();
    if (answer && !*answer)
      for (const auto& subject : subjects_)
        found_.spared[subject->name()] += subject->decide(query).hit ? 1 : 0;
  }

  Verification finish() {
    decide_all();
    return std::move(found_);
  }

 private:
  void decide_all() {
    std::vector<Decision> decisions(queries_.size());
    decide(queries_, decisions);
    for (std::size_t i = 0; i < queries_.size(); ++i)
      found_.wrong += decisions[i].collision != expected_[i] ? 1 : 0;
    found_.left_out += queries_.size();
    queries_.clear();
    expected_.clear();
  }

  const Subjects& subjects_;
  std::vector<Query> queries_;
  std::vector<bool> expected_;
  Verification found_;
};

}  // namespace

void Verification::merge(const Verification& other) {
  left_out += other.left_out;
  wrong += other.wrong;
  different_searches += other.different_searches;
  for (const auto& [subject, count] : other.spared) spared[subject] += count;
}

Verification verify_plan(const MovingMesh& mesh, const Subjects& subjects, int jobs,
                         const std::function<bool(double)>& progress) {
  Verification sum;
  std::atomic<bool> stop = false;
  for (const Kind kind : kinds) {
    Fingerprint by_boxes;
    Fingerprint by_sweep;
    const auto stopped = [&] { return stop.load(); };
    find_candidates(
        mesh, kind, [&](const Candidate& each) { by_boxes.add(each); }, stopped);
    find_candidates_by_sweep(
        mesh, kind, [&](const Candidate& each) { by_sweep.add(each); }, stopped);
    sum.different_searches += by_boxes == by_sweep ? 0 : 1;

    const std::size_t rows = pair_rows(mesh, kind);
    std::mutex mutex;
    std::size_t done = 0;
    in_parallel(jobs, rows, [&](std::size_t row) {
      if (stop) return;
      Check check(subjects);
      for_pairs_of_row(mesh, kind, row, [&](const Candidate& each) { check.take(make_query(mesh, each)); });
      const std::lock_guard lock(mutex);
      sum.merge(check.finish());
      const double part = static_cast<double>(++done) / static_cast<double>(rows);
      if (!progress(kind == kinds[0] ? part / 2 : 0.5 + part / 2)) stop = true;
    });
  }
  return sum;
}

std::string describe(const Verification& verification) {
  std::string text =
      fmt::format("{}: {} pairs are left out, of {} the oracle says otherwise; {}\n",
                  verification.fine() ? "plan verified" : "THE PLAN IS WRONG",
                  with_separators(verification.left_out), with_separators(verification.wrong),
                  verification.different_searches == 0 ? "box intersection and sweep find the same pairs"
                                                       : "BOX INTERSECTION AND SWEEP DIFFER");
  for (const auto& [subject, count] : verification.spared)
    text += fmt::format("false positives of {} that the plan spares: {}\n", subject, with_separators(count));
  return text;
}

}  // namespace nearmiss
