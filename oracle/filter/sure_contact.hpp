// Contacts that no search in floating-point arithmetic finds, because F, the coplanarity cubic, or a weight
// is exactly zero at the contact.
#pragma once

#include "ccd/query/query.hpp"

namespace nearmiss::certified {

/// Whether the primitives touch at a time in [0, 1], by exact predicates. The answer is exact if the
/// coordinates of all vertices at that time are certainly doubles, as they are at t = 0 and t = 1. Otherwise
/// the answer is false.
bool touch_at(const Query& query, double time);

/// Whether a vertex certainly crosses an edge of the other primitive while both stay in a plane perpendicular
/// to an axis. The plane may move along the axis. Scenes of boxes and grids have many such contacts.
bool crosses_in_a_plane(const Query& query);

}  // namespace nearmiss::certified
