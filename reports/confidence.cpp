#include "reports/confidence.hpp"

#include <boost/math/distributions/binomial.hpp>

namespace nearmiss {

namespace {

using Binomial = boost::math::binomial_distribution<>;

double upper(std::uint64_t count, std::uint64_t total, double risk) {
  if (count >= total) return 1;
  return Binomial::find_upper_bound_on_p(static_cast<double>(total), static_cast<double>(count), risk);
}

double lower(std::uint64_t count, std::uint64_t total, double risk) {
  if (count == 0) return 0;
  return Binomial::find_lower_bound_on_p(static_cast<double>(total), static_cast<double>(count), risk);
}

}  // namespace

double clopper_pearson_upper(std::uint64_t count, std::uint64_t total) { return upper(count, total, 0.05); }

Interval clopper_pearson(std::uint64_t count, std::uint64_t total, double risk) {
  return {lower(count, total, risk / 2), upper(count, total, risk / 2)};
}

}  // namespace nearmiss
