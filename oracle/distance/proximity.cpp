#include "oracle/distance/proximity.hpp"

#include <algorithm>

#include "oracle/exact/nearness.hpp"

namespace nearmiss {

bool comes_within(const Query& query, double bound) {
  const exact::Nearness nearness(query, bound);
  const auto is_near = [&](exact::Root& t) { return nearness.holds_at(t); };
  if (exact::Root start{exact::Number(0)}; is_near(start)) return true;
  const auto is_near_at_a_root = [&](const exact::Polynomial& p) {
    return !p.is_zero() && holds_at_a_root(p, is_near);
  };
  return std::any_of(nearness.statements().begin(), nearness.statements().end(),
                     [&](const exact::FeatureNearness& each) {
                       if (!each.excess.is_zero()) return is_near_at_a_root(each.excess);
                       return std::any_of(each.outside.begin(), each.outside.end(), is_near_at_a_root);
                     });
}

}  // namespace nearmiss
