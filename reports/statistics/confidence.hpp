// Computes confidence bounds of rates, and exact tests that compare two rates.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace nearmiss {

/// The one-sided 95 % upper confidence bound of a rate if `count` events were seen in `total` trials (Clopper
/// and Pearson 1934): if the rate equals the bound, the probability of at most `count` events is 5 %. The
/// bound is 1 if `total` is 0.
double clopper_pearson_upper(std::uint64_t count, std::uint64_t total);

struct ConfidenceInterval {
  double lo = 0, hi = 1;

  bool operator==(const ConfidenceInterval&) const = default;
};

/// The two-sided confidence interval of Clopper and Pearson. The true rate is below the interval with a
/// probability of at most `risk` / 2, and above the interval with a probability of at most `risk` / 2. The
/// interval is [0, 1] if `total` is 0.
ConfidenceInterval clopper_pearson(std::uint64_t count, std::uint64_t total, double risk = 0.05);

double student_t_quantile_975(std::size_t degrees_of_freedom);

/// A number of events among a number of trials: count <= total.
struct Proportion {
  std::uint64_t count = 0, total = 0;

  /// NaN if total is 0.
  [[nodiscard]] double rate() const { return static_cast<double>(count) / static_cast<double>(total); }

  Proportion& operator+=(const Proportion& other) {
    count += other.count;
    total += other.total;
    return *this;
  }
};

/// The one-sided p-values of a test of two proportions, `now` and `before`. They are probabilities under the
/// assumption that both proportions have the same rate.
struct ExactTest {
  double more = 1;  ///< probability of a count at least as large as now.count
  double less = 1;  ///< probability of a count at most as large as now.count

  /// The two-sided p-value: twice the smaller one-sided p-value, but at most 1.
  [[nodiscard]] double either() const { return std::min({1.0, 2 * more, 2 * less}); }
};

/// The significance level of each of several tests that share a risk (Bonferroni).
double level_of(double risk, std::size_t tests);

/// Fisher's exact test, which takes the sum of the two counts as given. If the totals add up to more than
/// 2^31, or the counts to more than a million, the test replaces the hypergeometric distribution by a
/// binomial distribution, which gives larger p-values.
ExactTest fisher_test(const Proportion& now, const Proportion& before);

/// An exact test like fisher_test, but for several pairs {now, before} together. The rate may differ from
/// pair to pair. If the sum of a pair's counts is given, now.count is distributed as the number of successes
/// in that many independent trials. The mean of their probabilities is now.total / (now.total +
/// before.total). The test uses the binomial distribution with the number of trials of all pairs and the mean
/// of their probabilities. By Hoeffding's theorem (1956), the tails of this distribution, at a distance of at
/// least 1 from the expectation, are at least as large as the tails of the sum of now.count over all pairs.
ExactTest pooled_test(const std::vector<std::pair<Proportion, Proportion>>& pairs);

}  // namespace nearmiss
