// The search space of directed search: contacts with a gap and displacements, from which queries are made.
#pragma once

#include <array>

#include "fuzz/families/contacts.hpp"

namespace nearmiss {

/// How far each vertex is moved, in the order of Query::x.
using Displacements = std::array<double, 24>;

/// A contact, in the frame in which `base` is at rest at the origin, with a gap between the primitives, and
/// displacements that are then added to the vertices.
struct SearchPoint {
  Path q, r;
  Vector3<double> w;      ///< velocity of the first primitive's point of contact
  Vector3<double> place;  ///< α, β, time
  Vector3<double> gap;
  Displacements moved{};

  /// Visits all vectors except the displacements; also skips the gap if the primitives must touch.
  template <class Visit>
  void visit(bool touching, const Visit& visit_vector) {
    for (Vector3<double>* v : {&q.start, &q.end, &r.start, &r.end, &w, &place}) visit_vector(*v);
    if (!touching) visit_vector(gap);
  }
};

/// The lower end of the usual range of sizes and speeds.
inline constexpr double usually_smallest = 1e-5;

/// A log-uniform number from lo to hi, with the same bits with every C library.
double search_log_uniform(Random& random, double lo, double hi);

/// Draws primitives with sizes and speeds from `smallest` to 1, without a gap. Some primitives are thin, move
/// in their plane, or stay near one plane; contact may be on a border or at an end of the step.
SearchPoint draw_search_point(Random& random, double smallest);

/// Rounds to a grid on which contact is exact.
SearchPoint on_grid(SearchPoint point);

/// A gap whose components are uniform in [-h, h), for every finite h.
Vector3<double> draw_gap(Random& random, double h);

/// The point with its gap shortened to at most h.
SearchPoint with_gap_within(SearchPoint point, double h);

Contact contact_of(Kind kind, const SearchPoint& point);

/// The query of a point, for a separation h.
Query query_of(Kind kind, const SearchPoint& point, double h);

/// log2 of six ratios. The smaller a ratio, the harder the contact.
std::array<double, 6> hardness(Kind kind, const SearchPoint& point);

}  // namespace nearmiss
