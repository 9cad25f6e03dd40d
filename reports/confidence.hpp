// Confidence bounds of rates.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace nearmiss {

/// The one-sided 95 % upper confidence bound of a rate of which `count` in `total` were seen (Clopper and
/// Pearson 1934): the rate at which seeing no more than `count` has probability 5 %. 1 where nothing was
/// looked at.
double clopper_pearson_upper(std::uint64_t count, std::uint64_t total);

/// What a rate may be, in [0, 1].
struct Interval {
  double lo = 0, hi = 1;

  bool operator==(const Interval&) const = default;
};

/// The two-sided interval of Clopper and Pearson: the true rate is below it with probability `risk` / 2 at
/// most, and above it likewise. [0, 1] where nothing was looked at.
Interval clopper_pearson(std::uint64_t count, std::uint64_t total, double risk = 0.05);

/// What a variable of Student's t-distribution exceeds with probability 2.5 %.
double student_t_quantile_975(std::size_t degrees_of_freedom);

/// Something that was counted, and among how many: count <= total.
struct Share {
  std::uint64_t count = 0, total = 0;

  /// Not a number if there is nothing to count among.
  [[nodiscard]] double rate() const { return static_cast<double>(count) / static_cast<double>(total); }

  Share& operator+=(const Share& other) {
    count += other.count;
    total += other.total;
    return *this;
  }
};

/// Fisher's exact test of two shares: how likely it is, where both have the same rate, that `now` is at least as
/// large against `before`, given their sum; and at least as small. Of more than 2^31 in all, or a million counted, by
/// a binomial distribution, which says a larger probability.
struct ExactTest {
  double more = 1, less = 1;

  /// Two-sided: twice the smaller one, 1 at most.
  [[nodiscard]] double either() const { return std::min({1.0, 2 * more, 2 * less}); }
};
ExactTest fisher_test(const Share& now, const Share& before);

/// The same of the sum over several pairs of shares, {now, before}, of which each has the same rate twice. Given its
/// sum, each pair's `now` is a sum of trials whose probability is now.total among both totals, or less spread than
/// that; so is the sum over all, by Hoeffding's theorem (1956), against as many trials of their mean probability.
ExactTest pooled_test(const std::vector<std::pair<Share, Share>>& pairs);

}  // namespace nearmiss
