#include "reports/statistics/counts.hpp"

#include <numeric>

#include "reports/statistics/failure.hpp"

namespace nearmiss {

namespace {

/// The order of cases, farthest first. Cases with equal ratios are ordered by their queries, so that merging
/// in any order keeps the same cases.
bool farther(const FarCase& a, const FarCase& b) {
  if (a.ratio != b.ratio) return a.ratio > b.ratio;
  return std::tie(a.query.kind, a.query.x, a.query.separation, a.provenance) <
         std::tie(b.query.kind, b.query.x, b.query.separation, b.provenance);
}

}  // namespace

void add_up(std::vector<FarCase>& own, const std::vector<FarCase>& other) {
  own.insert(own.end(), other.begin(), other.end());
  std::sort(own.begin(), own.end(), farther);
  own.erase(std::unique(own.begin(), own.end()), own.end());
  if (own.size() > Counts::far_cases) own.resize(Counts::far_cases);
}

void keep_farthest(std::vector<FarCase>& kept, double ratio, const Query& query,
                   const std::function<std::string()>& provenance) {
  if (ratio >= Counts::least_kept(kept)) add_up(kept, {{ratio, query, provenance()}});
}

void Counts::add(const Outcome& outcome, const Query& query, const std::function<std::string()>& provenance) {
  const bool hit = outcome.verdict.hit;
  const auto stage = static_cast<std::size_t>(outcome.verdict.stage);
  const auto of = static_cast<std::size_t>(outcome.query_class);
  ++queries;
  if (outcome.verdict.fault != Fault::none) {
    ++faults[static_cast<std::size_t>(outcome.verdict.fault)];
    if (failure_of(outcome) == FailureKind::fault) ++faults_by_class[of];
    return;
  }
  collisions += outcome.collision ? 1 : 0;
  positives += hit ? 1 : 0;
  rejected_by[static_cast<std::size_t>(outcome.verdict.rejection)] += hit ? 0 : 1;
  if (outcome.collision) {
    if (hit) {
      ++true_by_stage[stage];
    } else {
      ++false_negatives;
      ++missed_by_class[of];
    }
    if (outcome.time) {
      add_time(*outcome.time, query, provenance);
      late_by_class[of] += outcome.time->late ? 1 : 0;
      committed_by_class[of] += outcome.time->committed ? 1 : 0;
    }
  } else if (hit) {
    ++false_positives;
    ++false_by_stage[stage];
    distances.add(outcome.ratio);
    refuted_bounds += outcome.bound_refuted ? 1 : 0;
    refuted_by_class[of] += outcome.bound_refuted ? 1 : 0;
    measured_by_wang += outcome.measured_by_wang ? 1 : 0;
    keep_farthest(farthest, outcome.ratio, query, provenance);
  }
}

void Counts::add_time(const TimeError& time, const Query& query,
                      const std::function<std::string()>& provenance) {
  ++times_given;
  times_promised += time.promised ? 1 : 0;
  late += time.late ? 1 : 0;
  stuck += time.stuck ? 1 : 0;
  committed += time.committed ? 1 : 0;
  unsafe_steps += time.unsafe_step ? 1 : 0;
  touch_at_end += time.touches_at_end ? 1 : 0;
  if (time.after > 0) {
    after.add(time.after);
    keep_farthest(latest, time.after, query, provenance);
  } else {
    early.add(time.early);
    travelled.add(time.travelled);
    if (time.early > 0) keep_farthest(earliest, time.early, query, provenance);
  }
}

Bin Counts::time_error_quantile(double part) const {
  Histogram all = early;
  all.merge(after);
  const Bin bin = all.quantile(part);
  return {bin.from, std::min(bin.to, max_time_error())};
}

std::uint64_t Counts::faults_total() const {
  return std::accumulate(faults.begin(), faults.end(), std::uint64_t{0});
}

bool Counts::is_possible() const {
  return collisions <= queries && faults_total() <= queries - collisions && positives <= queries &&
         false_negatives <= collisions && false_positives <= positives && refuted_bounds <= false_positives &&
         measured_by_wang <= false_positives && times_given <= collisions && times_promised <= times_given &&
         late <= times_promised && stuck <= times_given && committed <= times_promised - late &&
         unsafe_steps <= committed && touch_at_end <= times_promised - late - committed;
}

}  // namespace nearmiss
