// The first contact of a query's primitives, in exact arithmetic.
#pragma once

#include <optional>

#include "oracle/exact/predicates.hpp"
#include "oracle/exact/root.hpp"

namespace nearmiss::exact {

/// How the primitives meet at a time.
struct Meeting {
  /// How many weights vanish: none inside of triangle or edges, one on an edge or at one end, two in a vertex
  /// or at two ends. Primitives without a common normal always meet at a border: one or two.
  int vanishing_weights = 0;
  /// No common normal: a triangle without an area, edges parallel or without a length.
  bool degenerate = false;
};

/// The earliest time at which they meet, and how.
struct FirstContact {
  Root time;
  Meeting meeting;
};

/// Nothing if they never meet in [0, 1].
std::optional<FirstContact> first_contact(Predicates& predicates);

/// Whether they meet in [0, 1] at all.
bool any_collision(const Query& query);

}  // namespace nearmiss::exact
