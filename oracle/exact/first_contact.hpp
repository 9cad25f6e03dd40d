// The first contact of a query's primitives, in exact arithmetic.
#pragma once

#include <optional>

#include "oracle/exact/predicates.hpp"
#include "oracle/exact/root.hpp"

namespace nearmiss::exact {

/// How the primitives meet at a time.
struct Meeting {
  /// The number of weights that vanish. For a vertex and a triangle, this number is 0 if they meet inside the
  /// triangle, 1 if they meet on an edge of the triangle, and 2 if they meet at a vertex of the triangle. For
  /// two edges, it is 0 if they meet inside both edges, 1 if they meet at an end of one edge, and 2 if they
  /// meet at an end of each edge. Primitives without a common normal always meet at a border, so the number
  /// is 1 or 2.
  int vanishing_weights = 0;
  /// Whether there is no common normal: the triangle has no area, or the edges are parallel or have no
  /// length.
  bool degenerate = false;
};

struct FirstContact {
  Root time;
  Meeting meeting;
};

/// The first contact of the primitives; nothing if they never meet in [0, 1].
std::optional<FirstContact> first_contact(Predicates& predicates);

/// Whether the primitives meet at any time in [0, 1]. `first` is the time of the first contact, if the search
/// happens to find this time.
struct Collision {
  bool any = false;
  std::optional<Root> first = std::nullopt;
};
Collision any_collision(const Query& query);

}  // namespace nearmiss::exact
