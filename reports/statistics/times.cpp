#include "reports/statistics/times.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "reports/statistics/histogram.hpp"

namespace nearmiss {

namespace {

std::uint64_t rounded_to_three_digits(std::uint64_t number) {
  std::uint64_t unit = 1;
  while (number / unit >= 1000) unit *= 10;
  return (number + unit / 2) / unit * unit;
}

}  // namespace

void BatchTimes::add(const BatchTime& time) {
  constexpr std::uint64_t ps_per_ns = 1000;
  if (time.queries == 0) return;
  const std::uint64_t ps = std::max(ps_per_ns, ps_per_ns * time.nanoseconds / time.queries);
  bins_[rounded_to_three_digits(ps)] += time.queries;
}

void BatchTimes::merge(const BatchTimes& other) {
  for (const auto& [bin, queries] : other.bins_) bins_[bin] += queries;
}

std::uint64_t BatchTimes::queries() const {
  return std::accumulate(bins_.begin(), bins_.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const auto& bin) { return sum + bin.second; });
}

double BatchTimes::median() const {
  return static_cast<double>(quantile_bin(bins_, 0.5, [](const auto& bin) { return bin.second; })->first) /
         1000;
}

void TimeHistogram::add(std::uint64_t nanoseconds) {
  const double octave = nanoseconds == 0 ? 0 : std::log2(static_cast<double>(nanoseconds));
  ++bins[std::min(static_cast<std::size_t>(octave * per_octave), bin_count - 1)];
}

void TimeHistogram::merge(const TimeHistogram& other) {
  for (std::size_t i = 0; i < bin_count; ++i) bins[i] += other.bins[i];
}

std::uint64_t TimeHistogram::total() const {
  return std::accumulate(bins.begin(), bins.end(), std::uint64_t{0});
}

std::optional<double> TimeHistogram::quantile(double part) const {
  const auto bin = quantile_bin(bins, part);
  if (bin == bins.end()) return std::nullopt;
  return std::exp2(static_cast<double>(bin - bins.begin() + 1) / per_octave);
}

namespace {

/// The order of cases, slowest first. Cases with equal run times are ordered by their provenance, so that
/// merging in any order keeps the same cases.
bool slower(const SlowCase& a, const SlowCase& b) {
  if (a.nanoseconds != b.nanoseconds) return a.nanoseconds > b.nanoseconds;
  return a.provenance < b.provenance;
}

}  // namespace

void add_up(std::vector<SlowCase>& own, const std::vector<SlowCase>& other) {
  own.insert(own.end(), other.begin(), other.end());
  std::sort(own.begin(), own.end(), slower);
  if (own.size() > SubjectTimes::slow_cases) own.resize(SubjectTimes::slow_cases);
}

void add_up(BatchesByFamily& own, const BatchesByFamily& other) {
  for (const auto& [key, times] : other) own[key].merge(times);
}

void SubjectTimes::add(Kind kind, const std::string& family, const BatchTime& time) {
  if (time.queries == 0) return;
  batches[{kind, family}].add(time);
  nanoseconds += time.nanoseconds;
}

void SubjectTimes::add(std::uint64_t time, const Query& query,
                       const std::function<std::string()>& provenance) {
  each.add(time);
  if (slowest.size() == slow_cases && time < slowest.back().nanoseconds) return;
  add_up(slowest, {{time, query, provenance()}});
}

std::uint64_t SubjectTimes::queries() const {
  return std::accumulate(batches.begin(), batches.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const auto& times) { return sum + times.second.queries(); });
}

std::optional<double> SubjectTimes::ns_per_query() const {
  if (queries() == 0) return std::nullopt;
  const double sum =
      std::accumulate(batches.begin(), batches.end(), 0.0, [](double total, const auto& times) {
        return total + times.second.median() * static_cast<double>(times.second.queries());
      });
  return sum / static_cast<double>(queries());
}

std::optional<double> SubjectTimes::mean() const {
  if (queries() == 0) return std::nullopt;
  return static_cast<double>(nanoseconds) / static_cast<double>(queries());
}

}  // namespace nearmiss
