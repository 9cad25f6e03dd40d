#include "reports/statistics/confidence.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/hypergeometric.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <utility>

namespace nearmiss {

namespace {

using Binomial = boost::math::binomial_distribution<>;

/// The largest number of trials for which Boost's functions converge reliably. A larger number of trials is
/// scaled down to this number, which only widens intervals and raises p-values.
constexpr double most_trials = 0x1p40;

std::pair<double, double> scaled(double trials, double successes) {
  const double factor = std::min(1.0, most_trials / trials);
  return {factor * trials, factor * successes};
}
std::pair<double, double> scaled(std::uint64_t total, std::uint64_t count) {
  return scaled(static_cast<double>(total), static_cast<double>(count));
}

double upper(std::uint64_t count, std::uint64_t total, double risk) {
  if (count >= total) return 1;
  const auto [trials, successes] = scaled(total, count);
  return Binomial::find_upper_bound_on_p(trials, successes, risk);
}

double lower(std::uint64_t count, std::uint64_t total, double risk) {
  if (count == 0 || total == 0) return 0;
  const auto [trials, successes] = scaled(total, std::min(count, total));
  return Binomial::find_lower_bound_on_p(trials, successes, risk);
}

}  // namespace

double clopper_pearson_upper(std::uint64_t count, std::uint64_t total) { return upper(count, total, 0.05); }

ConfidenceInterval clopper_pearson(std::uint64_t count, std::uint64_t total, double risk) {
  return {lower(count, total, risk / 2), upper(count, total, risk / 2)};
}

double student_t_quantile_975(std::size_t degrees_of_freedom) {
  return quantile(boost::math::students_t(static_cast<double>(degrees_of_freedom)), 0.975);
}

double level_of(double risk, std::size_t tests) {
  return risk / static_cast<double>(std::max<std::size_t>(1, tests));
}

namespace {

/// P(X >= count) and P(X <= count) for a random number X with this distribution. The smallest value of X is
/// `least`.
template <class Distribution, class Number>
ExactTest tails(const Distribution& distribution, Number count, Number least) {
  return {count == least ? 1 : cdf(complement(distribution, count - 1)), cdf(distribution, count)};
}

}  // namespace

ExactTest fisher_test(const Proportion& now, const Proportion& before) {
  const std::uint64_t total = now.total + before.total;
  const std::uint64_t counted = now.count + before.count;
  if (counted == 0 || counted == total || now.total == 0 || before.total == 0) return {};
  constexpr std::uint64_t largest_total = 1ULL << 31;
  constexpr std::uint64_t most_counted = 1000000;
  if (total > largest_total || counted > most_counted) {
    const auto [trials, successes] = scaled(counted, now.count);
    return tails(Binomial(trials, static_cast<double>(now.total) / static_cast<double>(total)),
                 std::round(successes), 0.0);
  }
  const auto number = [](std::uint64_t n) { return static_cast<unsigned>(n); };
  const boost::math::hypergeometric_distribution<> drawn(number(counted), number(now.total), number(total));
  const std::uint64_t least = counted > before.total ? counted - before.total : 0;
  return tails(drawn, number(now.count), number(least));
}

ExactTest pooled_test(const std::vector<std::pair<Proportion, Proportion>>& pairs) {
  double trials = 0;
  double expected = 0;
  double seen = 0;
  for (const auto& [now, before] : pairs) {
    const auto both = static_cast<double>(now.count + before.count);
    trials += both;
    expected += both * static_cast<double>(now.total) / static_cast<double>(now.total + before.total);
    seen += static_cast<double>(now.count);
  }
  if (std::abs(seen - expected) < 1) return {};  // Hoeffding's theorem does not apply, so both p-values are 1
  const auto [of, successes] = scaled(trials, seen);
  return tails(Binomial(of, expected / trials), std::round(successes), 0.0);
}

}  // namespace nearmiss
