// Makes problems from the computations of ccd/, by running the templates of ccd/ with recording scalars. Each
// function below returns the problem of bounding the rounding error of one computed quantity.
#pragma once

#include "ccd/query/query.hpp"
#include "tests/proofs/problem.hpp"

namespace nearmiss::proofs {

inline constexpr Kind vt = Kind::vertex_triangle;
inline constexpr Kind ee = Kind::edge_edge;

/// Bounds of the vectors of a pair, in terms of the pair's bound B. For two edges, p joins the end points
/// that are closest at t = 0. So p is within B at t = 0, but only within 2B at other times. The paper assumes
/// that all vectors are within B at all times.
enum class Reach : std::uint8_t {
  near,  ///< all vectors are within B
  far,   ///< p of two edges, x_0i in a VE test, and x_ji in a VV test are within 2B
};

/// Parts of the configuration of a pair at one time (proximity.hpp): a component of the normal N, the
/// comparison of the height test, a weight, or a comparison of the barycentric test.
enum class ConfigurationPart : std::uint8_t { normal, height, weight, inside };
Problem configuration(Kind kind, Reach reach, ConfigurationPart part);

/// Parts of the cubic (cubic.hpp): its coefficients, and its value at a time.
enum class CubicPart : std::uint8_t { a, b, c, d, value };
/// The error of a part of the cubic that is computed from rounded vectors.
Problem cubic(Kind kind, CubicPart part);
/// The error of a part of the cubic that is computed from exact vectors.
Problem exact_cubic(CubicPart part);
/// The error of the cubic's value that Horner's rule computes from exact coefficients.
Problem horner();
/// The error of the cubic's clearance that is computed from exact coefficients.
Problem clearance_of_exact();

/// The error of the computed bound B of a pair (motion.hpp).
Problem bound(Kind kind);
/// The error of E + W, a part of the bound B. E bounds the edges at t = 0, and W bounds the relative
/// velocities.
Problem extents(Kind kind);

/// The error of the computed bound on how much a weight changes, in the culling of vertex-edge tests
/// (ve_culling.hpp).
Problem spread(Kind kind);
/// The error of the comparison of a weight with N·N plus slack, in the culling of vertex-edge tests.
Problem culling(Kind kind);

/// Parts of the test of a vertex and an edge (vertex_edge.hpp).
enum class EdgePart : std::uint8_t { length2, weight, inside, F, F_without_S, F_of_S };
Problem vertex_edge(Reach reach, EdgePart part);

/// Parts of the test of two vertices (vertex_vertex.hpp): x·v and v·v; the time, for ‖v‖∞ = 1, before it is
/// clamped to [0, 1]; the squared distance at a given time.
enum class VertexPart : std::uint8_t { xv, vv, time, squared_distance };
/// The error of a part of the test of two vertices that is computed from exact vectors.
Problem exact_vertices(Reach reach, VertexPart part);
/// The error of the squared distance of two vertices at a given time, computed from rounded vectors.
Problem vertices(Reach reach);

}  // namespace nearmiss::proofs
