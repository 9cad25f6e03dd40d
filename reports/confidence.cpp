#include "reports/confidence.hpp"

#include <boost/math/distributions/binomial.hpp>

namespace nearmiss {

double clopper_pearson_upper(std::uint64_t count, std::uint64_t total) {
  if (count >= total) return 1;
  constexpr double alpha = 0.05;
  return boost::math::binomial_distribution<>::find_upper_bound_on_p(static_cast<double>(total),
                                                                     static_cast<double>(count), alpha);
}

}  // namespace nearmiss
