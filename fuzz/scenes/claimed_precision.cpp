#include "fuzz/scenes/claimed_precision.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "ccd/wang/pair_bound.hpp"

namespace nearmiss {

namespace {

constexpr std::size_t timed_pairs = 20000;
// The number of measurements. The shortest measured time counts, since disturbances only add time.
constexpr int timings = 5;

double quickest_ns(const Subject& subject, const std::vector<Query>& queries) {
  using Clock = std::chrono::steady_clock;
  std::vector<Verdict> verdicts(queries.size());
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < timings; ++i) {
    const auto start = Clock::now();
    subject.decide(queries, verdicts);
    const std::chrono::duration<double, std::nano> time = Clock::now() - start;
    best = std::min(best, time.count());
  }
  return queries.empty() ? 0 : best / static_cast<double>(queries.size());
}

}  // namespace

std::vector<ClaimedPrecision> claimed_precisions(const Scene& scene, LeaveOut leave_out,
                                                 const Subjects& subjects) {
  std::vector<ClaimedPrecision> found;
  for (const auto& subject : subjects) found.push_back({.subject = subject->name()});
  std::vector<Query> sample;
  const auto look = [&](const AskedPairs& pairs) {
    for (const Query& query : pairs.queries) {
      if (sample.size() < timed_pairs) sample.push_back(query);
      for (std::size_t i = 0; i < subjects.size(); ++i)
        found[i].claimed = std::max(found[i].claimed, subjects[i]->distance_bound(query));
    }
  };
  for_each_step(scene, never_over, [&](std::size_t, const MovingMesh& mesh) {
    follow_plan(Plan(mesh, leave_out), look, {}, never_over);
  });
  for (std::size_t i = 0; i < subjects.size(); ++i) found[i].ns_per_query = quickest_ns(*subjects[i], sample);
  return found;
}

const ClaimedPrecision* cheapest_within(const std::vector<ClaimedPrecision>& all, double thickness) {
  const ClaimedPrecision* best = nullptr;
  for (const ClaimedPrecision& each : all)
    if (each.claimed <= thickness && (best == nullptr || each.ns_per_query < best->ns_per_query))
      best = &each;
  return best;
}

double scene_bound(const Scene& scene) {
  double largest = 0;
  for_each_step(scene, never_over, [&](std::size_t, const MovingMesh& mesh) {
    find_candidates(mesh, [&](const Candidate& candidate) {
      largest = std::max(largest, pair_bound(make_query(mesh, candidate)));
    });
  });
  const double unit = std::pow(10, std::floor(std::log10(largest)) - 3);
  const double rounded = std::ceil(largest / unit) * unit;
  return rounded >= largest && std::isfinite(rounded) ? rounded : largest;
}

}  // namespace nearmiss
