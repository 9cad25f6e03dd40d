// The time of a query's first contact, or of its first approach to a separation, by the exact method.
#pragma once

#include <optional>

#include "oracle/exact/first_approach.hpp"
#include "oracle/exact/first_contact.hpp"

namespace nearmiss::testing {

/// The exact times at which the distance of the primitives is first at most the separation h, and first below
/// h. For h = 0, both are the time of contact.
inline std::optional<exact::FirstApproach> exact_times(const Query& query) {
  if (query.separation > 0) return exact::first_approach(query);
  exact::Predicates predicates(query);
  auto contact = exact::first_contact(predicates);
  if (!contact) return std::nullopt;
  return exact::FirstApproach{contact->time, contact->time};
}

/// Whether a root is before a time. The time need not be in [0, 1].
inline bool is_before(exact::Root& root, double time) {
  exact::Root other{exact::Number(time)};
  return root.is_below(other);
}

}  // namespace nearmiss::testing
