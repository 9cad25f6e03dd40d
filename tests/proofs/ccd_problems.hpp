// The computations of ccd/ as problems: its templates run with recorded numbers.
#pragma once

#include "ccd/query.hpp"
#include "tests/proofs/problem.hpp"

namespace nearmiss::proofs {

/// Bounds of the vectors of a pair. For edges p is within B at t = 0 alone, since the closest end points come
/// first, and thus within 2B at any other time. The paper has all of them within B at all times.
enum class Reach : std::uint8_t {
  near,  ///< all within B
  far,   ///< p (edges), x_0i (vertex against an edge) and x_ji (two vertices) may be within 2B
};

/// The configuration at a time (proximity.hpp): a component of N, or one side or both of a comparison.
enum class ConfigurationPart : std::uint8_t { normal, height, weight, inside };
Problem configuration(Kind kind, Reach reach, ConfigurationPart part);

/// The cubic (cubic.hpp).
enum class CubicPart : std::uint8_t { a, b, c, d, value };
Problem cubic(Kind kind, CubicPart part);
/// Its coefficients from vectors that are exact.
Problem exact_cubic(CubicPart part);
/// Horner's rule from coefficients that are exact, and the bound from Bernstein coefficients.
Problem horner();
Problem clearance_of_exact();

/// B, and E + W within it (motion.hpp).
Problem bound(Kind kind);
Problem extents(Kind kind);

/// Culling of vertex-edge tests (ve_culling.hpp): how far a weight may move, and the comparison of a weight
/// with N·N and all that is added to it.
Problem spread(Kind kind);
Problem culling(Kind kind);

/// Vertex against edge (vertex_edge.hpp).
enum class EdgePart : std::uint8_t { length2, weight, inside, F, F_without_S, F_of_S };
Problem vertex_edge(Reach reach, EdgePart part);

/// Two vertices (vertex_vertex.hpp), of exact vectors: x·v, v·v; the time, for ‖v‖∞ = 1, before it is brought
/// into [0, 1]; the squared distance at a given time.
enum class VertexPart : std::uint8_t { xv, vv, time, squared_distance };
Problem exact_vertices(Reach reach, VertexPart part);
/// The squared distance at a given time, of rounded vectors.
Problem vertices(Reach reach);

}  // namespace nearmiss::proofs
