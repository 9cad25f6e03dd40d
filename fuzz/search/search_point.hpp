// The search space of directed search. A point of this space determines a query: by a contact, a gap between
// the primitives, and displacements of the vertices.
#pragma once

#include <array>

#include "fuzz/families/contacts.hpp"

namespace nearmiss {

/// How far each vertex is moved, in the order of Query::x.
using Displacements = std::array<double, 24>;

/// A contact, a gap between the primitives, and displacements, which are added to the vertices' positions in
/// the end. In the contact, Contact::base is at rest at the origin.
struct SearchPoint {
  Path q, r;
  Vector3<double> w;      ///< the velocity of the first primitive's point of contact
  Vector3<double> place;  ///< α, β, time
  Vector3<double> gap;
  Displacements moved{};

  /// Calls `visit_vector` for each vector. Skips the gap if the primitives must touch (`touching`).
  template <class Visit>
  void visit(bool touching, const Visit& visit_vector) {
    for (Vector3<double>* v : {&q.start, &q.end, &r.start, &r.end, &w, &place}) visit_vector(*v);
    if (!touching) visit_vector(gap);
  }
};

/// The lower end of the usual range of sizes and speeds.
inline constexpr double usually_smallest = 1e-5;

/// A log-uniform number from lo to hi. The number is the same whichever C library is used.
double search_log_uniform(Random& random, double lo, double hi);

/// Draws a contact of primitives with sizes and speeds from `smallest` to 1, without a gap. Some primitives
/// are thin, move in their plane, or stay near one plane. The contact may be on the border of a primitive, or
/// at an end of the step.
SearchPoint draw_search_point(Random& random, double smallest);

/// Rounds a point to a grid on which contact is exact.
SearchPoint on_grid(SearchPoint point);

/// Draws a gap whose components are uniform in [-h, h). Every finite h is allowed.
Vector3<double> draw_gap(Random& random, double h);

SearchPoint with_gap_within(SearchPoint point, double h);

Contact contact_of(Kind kind, const SearchPoint& point);

Query query_of(Kind kind, const SearchPoint& point, double h);

/// Returns log2 of six ratios. Each ratio is smaller for harder contacts:
/// - the sine of the angle between the relative motion and the plane of q and r
/// - the sine of the angle between q and r
/// - the smallest weight
/// - the shorter of q and r over the longer one
/// - the distance of the time from 0 or 1
/// - the longer of q and r over the relative motion
std::array<double, 6> hardness(Kind kind, const SearchPoint& point);

}  // namespace nearmiss
