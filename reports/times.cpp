#include "reports/times.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "reports/quantile.hpp"

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

double TimeHistogram::quantile(double part) const {
  const auto bin = quantile_bin(bins, part);
  if (bin == bins.end()) return std::numeric_limits<double>::quiet_NaN();
  return std::exp2(static_cast<double>(bin - bins.begin() + 1) / per_octave);
}

namespace {

bool slower(const SlowCase& a, const SlowCase& b) {
  if (a.nanoseconds != b.nanoseconds) return a.nanoseconds > b.nanoseconds;
  return a.provenance < b.provenance;
}

void keep_slowest(std::vector<SlowCase>& cases) {
  std::sort(cases.begin(), cases.end(), slower);
  if (cases.size() > Times::slow_cases) cases.resize(Times::slow_cases);
}

}  // namespace

void Times::add(Kind kind, const std::string& family, const BatchTime& time) {
  if (time.queries == 0) return;
  batches[{kind, family}].add(time);
  nanoseconds += time.nanoseconds;
}

void Times::add(std::uint64_t time, const Query& query, const std::function<std::string()>& provenance) {
  each.add(time);
  if (slowest.size() == slow_cases && time <= slowest.back().nanoseconds) return;
  slowest.push_back({time, query, provenance()});
  keep_slowest(slowest);
}

void Times::merge(const Times& other) {
  for (const auto& [key, times] : other.batches) batches[key].merge(times);
  nanoseconds += other.nanoseconds;
  each.merge(other.each);
  slowest.insert(slowest.end(), other.slowest.begin(), other.slowest.end());
  keep_slowest(slowest);
}

std::uint64_t Times::queries() const {
  return std::accumulate(batches.begin(), batches.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const auto& times) { return sum + times.second.queries(); });
}

double Times::ns_per_query() const {
  const double sum =
      std::accumulate(batches.begin(), batches.end(), 0.0, [](double total, const auto& times) {
        return total + times.second.median() * static_cast<double>(times.second.queries());
      });
  return sum / static_cast<double>(queries());
}

double Times::mean() const { return static_cast<double>(nanoseconds) / static_cast<double>(queries()); }

}  // namespace nearmiss
