// The first contact of a query's primitives, in exact arithmetic.
#pragma once

#include <optional>

#include "oracle/exact/predicates.hpp"
#include "oracle/exact/root.hpp"

namespace nearmiss::exact {

/// How the primitives meet at a time.
struct Meeting {
  /// The number of weights that vanish: none for a contact inside the triangle or the edges, one on an edge
  /// or at one end, two at a vertex or at two ends. Primitives without a common normal always meet at a
  /// border, so the number is one or two.
  int vanishing_weights = 0;
  /// There is no common normal: the triangle has no area, or the edges are parallel or have no length.
  bool degenerate = false;
};

/// The earliest time at which the primitives meet, and how they meet.
struct FirstContact {
  Root time;
  Meeting meeting;
};

/// The first contact of the primitives; nothing if they never meet in [0, 1].
std::optional<FirstContact> first_contact(Predicates& predicates);

/// Whether the primitives meet in [0, 1] at all. `first` is set if the search happens to find the first
/// contact.
struct Collision {
  bool any = false;
  std::optional<Root> first = std::nullopt;
};
Collision any_collision(const Query& query);

}  // namespace nearmiss::exact
