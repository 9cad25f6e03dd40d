// Queries of a vertex and an edge, or of two vertices, that the other families rarely make. x is the family's
// parameter, and h is the separation.
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "ccd/wang/elementary.hpp"
#include "fuzz/families/contacts.hpp"
#include "fuzz/families/tables.hpp"
#include "oracle/distance.hpp"

namespace nearmiss {

namespace {

using Vector = Vector3<double>;

/// The query in which the vector x0 - x1 follows the path `to_vertex`, and the vector x2 - x1 follows the
/// path `edge`. The path of x1 itself is random.
Query placed_beside(Random& random, Kind kind, const Path& to_vertex, const Path& edge, double size = 1) {
  const Path from = Path{random.vector(size), random.vector(size)};
  Query query{.kind = kind};
  query.set_start(0, from.start + to_vertex.start);
  query.set_end(0, from.end + to_vertex.end);
  query.set_start(1, from.start);
  query.set_end(1, from.end);
  query.set_start(2, from.start + edge.start);
  query.set_end(2, from.end + edge.end);
  repeat_vertices(query);
  return query;
}

/// Returns the query with a separation that is random, from (1 - 2^x) d to (1 + 2^x) d, where d is the
/// query's smallest distance. If d is 0, the separation is 2^x.
Query with_separation_beside(Random& random, const Query& query, double x) {
  const double off = random.uniform(-1, 1) * exp2_of(x);
  const double d = minimum_distance(query, 0).hi;
  return with_separation(query, d > 0 ? d + off * d : exp2_of(x));
}

/// The vectors x0 - x1 and x2 - x1 at t = 0, and their changes during the step.
struct Motion {
  Vector to_vertex, vertex_moves, edge, edge_moves;
};

constexpr double rounded_to = 1e-6;
/// Motions that a random search found. The paper's Algorithm 2 (vertex_edge.hpp) tests several candidate
/// times. If h is at most 1.09 times the smallest distance (1.22 times for the first four motions), the
/// vertex is within h of the edge only at the candidate times of case 2. These are the times at which a
/// quadratic piece of the algorithm's function F_0ij has its minimum.
const std::array<Motion, 5> at_minima{{
    {{-0.115823, 0.480718, -0.471951},
     {0.608612, -0.114713, 1.656110},
     {-0.346065, 1.185398, -1.163651},
     {1.704470, 1.459548, 2.294560}},
    {{0.352744, -0.377050, -0.013236},
     {-0.907806, 0.227645, 0.044980},
     {1.166621, -1.247007, -0.204212},
     {-0.472548, -1.951243, 0.681870}},
    {{-1.345035, -2.042608, -0.120709},
     {1.457833, 1.946917, -0.648448},
     {-2.250619, -2.294037, -0.107918},
     {0.600405, -2.034003, -1.422}},
    {{-0.725298, -0.442956, -0.620692},
     {-0.961383, 0.214471, -1.427232},
     {-2.993774, -0.726787, -2.688858},
     {0.872168, 0.439384, -0.485716}},
    {{0.405665, 0.405369, -0.223658},
     {0.493938, -0.161714, 0.212510},
     {0.809290, 0.809290, -0.809273},
     {2.345900, 1.582981, 0.115942}},
}};

/// One of the motions `at_minima`, changed slightly. The axes are permuted and reversed at random. In half of
/// the queries, the positions at t = 0 and at t = 1 are exchanged. The separation h differs from the smallest
/// distance by at most 2^x times the smallest distance.
Query at_minimum(Random& random, Kind kind, double x) {
  const Motion& motion = one_of(random, at_minima);
  const int turn = random.integer(0, 2);
  const int signs = random.integer(0, 7);
  const bool swaps = random.one_in(2);
  const auto moved = [&](const Vector& v) {
    Vector to;
    for (int k = 0; k < 3; ++k) to[(k + turn) % 3] = (signs >> k & 1) != 0 ? -v[k] : v[k];
    if (swaps) std::swap(to[0], to[1]);
    return to;
  };
  const auto path = [&](const Vector& start, const Vector& moves) {
    const Vector changed = start + rounded_to * random.vector(1);
    return Path{moved(changed), moved(changed + moves)};
  };
  Path to_vertex = path(motion.to_vertex, motion.vertex_moves);
  Path edge = path(motion.edge, motion.edge_moves);
  if (random.one_in(2)) {
    std::swap(to_vertex.start, to_vertex.end);
    std::swap(edge.start, edge.end);
  }
  return rescaled(random, with_separation_beside(random, placed_beside(random, kind, to_vertex, edge), x));
}

/// A vertex drifts slowly through an edge that grows. In one of four queries, the vertex passes beside the
/// edge; in one of four, it meets the edge's end x1. The three components of the cross product of x0 - x1 and
/// x2 - x1 have nearly equal magnitudes and are small at all times; h is far smaller than the edge.
Query drifting(Random& random, Kind kind, double x) {
  const double x_of_normal = random.one_in(2) ? 1 : -1;
  const double y_of_normal = random.one_in(2) ? 1 : -1;
  const Vector normal(x_of_normal, y_of_normal, 1);
  const Vector along = normal.cross(random.vector(1)).normalized();
  const Vector across = along.cross(normal).normalized();
  const double length = random.uniform(0.25, 1);
  const double growth = random.uniform(0, 2);
  const double meets_at = random.uniform();
  const double place = random.one_in(4) ? 0 : random.uniform(0.2, 0.8);
  const double speed = exp2_of(x);
  const double h = exp2_of(-random.uniform(32, 48));
  const Vector gap = (random.one_in(4) ? random.uniform(0, 4) * h : 0) * normal;
  const Path edge{length * along, length * (1 + growth) * along};
  const Path to_vertex{place * edge.start - meets_at * speed * across + gap,
                       place * edge.end + (1 - meets_at) * speed * across + gap};
  const Query query = placed_beside(random, kind, to_vertex, edge, random.one_in(2) ? 0 : 1);
  return rescaled(random, with_separation(query, h));
}

/// A vertex moves along the line of an edge, towards one of its ends.
Query along_the_line(Random& random, Kind kind, double x) {
  const Vector direction = random.integer_vector(4);
  const double shrinks_to = random.integer(0, 4) / 4.0;
  const double stops = random.integer(1, 8) / 8.0;
  const Path edge{direction, shrinks_to * direction};
  const double beyond = random.one_in(2) ? 1 + stops : -stops;
  const Path to_vertex{(beyond > 0 ? 4 : -3) * edge.start, beyond * edge.end};
  const Query query = placed_beside(random, kind, to_vertex, edge, 0);
  return rescaled(random, with_separation_beside(random, query, x));
}

/// At a time t, the edge is a single point, and the distance from the vertex to the edge is smallest.
/// Relative to the middle of the edge, the vertex moves in a direction that is perpendicular to the edge, and
/// to the vector from the middle to the vertex at t.
Query shrinking(Random& random, Kind kind, double x) {
  const double t = random.integer(1, 15) / 16.0;
  const Vector direction = random.vector(8);
  const Vector away = direction.cross(random.vector(1));
  const double largest = std::max(std::numeric_limits<double>::min(), away.lpNorm<Eigen::Infinity>());
  const Vector gap = away / largest / 8;
  const Vector sideways = random.uniform(-1, 1) * direction.cross(gap);
  const Path edge{-t * direction, (1 - t) * direction};
  const Path to_vertex{0.5 * edge.start + gap - t * sideways, 0.5 * edge.end + gap + (1 - t) * sideways};
  const Query query = placed_beside(random, kind, to_vertex, edge, random.one_in(2) ? 0 : 1);
  return rescaled(random, with_separation_beside(random, query, x));
}

}  // namespace

std::vector<Family> edge_families() {
  const auto beside = [](double most) {
    return [most](const char* name, const char* about, auto make) {
      Family family = with_parameter(
          name, about, {"h differs from the smallest distance by up to 2^x of it", -40, most, false, make});
      family.block_cases = 3;  // few queries, because computing their exact distance takes long
      return family;
    };
  };
  std::vector<Family> all{
      beside(-4)("v-minimum", "a vertex is within h of an edge only at the minimum of KKT case 2",
                 at_minimum),
      beside(0)("v-along", "a vertex moves along the line of an edge, which may shrink to a point",
                along_the_line),
      beside(0)("v-shrinking", "the edge is a point when the vertex is nearest", shrinking),
      with_parameter("v-drifting", "a vertex drifts through an edge that grows; h is far smaller",
                     {"speed / size of the edge = 2^x", -27, 0, false, drifting})};
  for (Family& family : all) {
    family.kinds = kinds_of_vertices;
    family.has_separation = true;
  }
  return all;
}

}  // namespace nearmiss
