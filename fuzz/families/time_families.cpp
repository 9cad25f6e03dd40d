// Exact contact at a time that is hard to find. The coplanarity cubic F has roots close together; or the
// primitives touch at one time only; or a contact that is easily missed precedes an obvious contact; or the
// primitives move slowly. x is the family's parameter.
#include <algorithm>
#include <array>
#include <cmath>

#include "fuzz/families/facing.hpp"
#include "fuzz/families/tables.hpp"

namespace nearmiss {

namespace {

using Vector = Vector3<double>;

// --- chosen roots ---------------------------------------------------------------------------------------

/// A linear factor of F: `start` at t = 0, `end` at t = 1. Its root, if any, is t = start / (start - end).
struct Factor {
  double start, end;

  static Factor vanishing_at(double time) { return {-time, 1 - time}; }
  static Factor constant() { return {1, 1}; }
};

/// A point with the weights α / whole and β / whole, in the sense of Contact. The point may be outside the
/// primitives. If `whole` is 0, there is no such point. Instead, s α q + β r = 0 at the root of the factor,
/// with s = alpha_sign(kind), so the sides are parallel at that time.
struct Weights {
  int whole, alpha, beta;

  [[nodiscard]] bool are_inside(Kind kind) const {
    if (alpha < 0 || beta < 0) return false;
    return has_triangle(kind) ? alpha + beta <= whole : alpha <= whole && beta <= whole;
  }
  [[nodiscard]] Vector column(Kind kind) const {
    return {1.0 * whole, -alpha_sign(kind) * alpha, -1.0 * beta};
  }
};

struct PlannedRoot {
  Factor factor;
  Vector direction;  ///< the direction in which the two points with these weights pass each other
  Weights weights;
};

double determinant(const Vector& a, const Vector& b, const Vector& c) { return a.dot(b.cross(c)); }

/// Whether the three roots have linearly independent directions, and also linearly independent vectors
/// Weights::column(). Otherwise, F would be 0 at all times.
bool are_independent(Kind kind, const std::array<PlannedRoot, 3>& roots) {
  const auto& [a, b, c] = roots;
  return determinant(a.direction, b.direction, c.direction) != 0 &&
         determinant(a.weights.column(kind), b.weights.column(kind), c.weights.column(kind)) != 0;
}

/// The positions of the vertices, at t = 0 or at t = 1, in a query whose F is a multiple of the product of
/// the three factors. At the root of a factor, the two points that have the weights of this root coincide. So
/// the primitives touch then if the points are inside the primitives.
///
/// The matrix with the columns p = x0 - base, q and r is M = U L adj(K). U has the directions as columns, L
/// has the factors on its diagonal, and K has the columns (whole, -s α, -β) with s = alpha_sign(kind). So M K
/// = det(K) U L, and F is det(M). Row i of adj(K) is the cross product of K's other two columns. All
/// operations are exact if numbers have few bits.
std::array<Vector, 4> vertices_with_roots(Kind kind, const Vector& base,
                                          const std::array<PlannedRoot, 3>& roots, double Factor::*at) {
  Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector next = roots[(i + 1) % 3].weights.column(kind);
    const Vector row = next.cross(roots[(i + 2) % 3].weights.column(kind));
    M += (roots[i].factor.*at * roots[i].direction) * row.transpose();
  }
  const Vector x0 = base + M.col(0);
  if (has_triangle(kind)) return {x0, base, base + M.col(1), base + M.col(2)};
  return {x0, x0 + M.col(1), base, base + M.col(2)};
}

/// Weights of a point strictly inside the triangle, or inside both edges.
Weights inside(Random& random, Kind kind) {
  const int whole = random.integer(5, 8);
  const int alpha = random.integer(1, whole - 2);
  const int beta = random.integer(1, has_triangle(kind) ? whole - 1 - alpha : whole - 1);
  return {whole, alpha, beta};
}

/// Weights, each from -2/5 to 7/5, of a point outside the primitives.
Weights outside(Random& random, Kind kind) {
  for (;;) {
    const int whole = random.integer(5, 8);
    const int alpha = random.integer(-2, whole + 2);
    const int beta = random.integer(-2, whole + 2);
    const Weights weights{whole, alpha, beta};
    if (!weights.are_inside(kind)) return weights;
  }
}

/// Returns the weights of a point on the border: on an edge of the triangle (vertex-triangle), or at an end
/// of one of the two edges (edge-edge). With a probability of 1/3, the point is a vertex of both primitives.
Weights border(Random& random, Kind kind) {
  const int whole = random.integer(5, 8);
  const int along = random.one_in(3) ? 0 : random.integer(1, whole - 1);
  return !has_triangle(kind) && random.one_in(2) ? Weights{whole, 0, along} : Weights{whole, along, 0};
}

/// Draws roots until they are independent, so that F is not identically zero. Then makes the query with these
/// roots, whose vertex x1 (vertex-triangle) or x2 (edge-edge) follows the path `base`.
template <class Draw>
Query with_drawn_roots(Random& random, Kind kind, const Path& base, const Draw& draw) {
  std::array<PlannedRoot, 3> roots = draw();
  while (!are_independent(kind, roots)) roots = draw();
  const auto start = vertices_with_roots(kind, base.start, roots, &Factor::start);
  const auto end = vertices_with_roots(kind, base.end, roots, &Factor::end);
  Query query{.kind = kind};
  for (int i = 0; i < 4; ++i) {
    query.set_start(i, start[static_cast<std::size_t>(i)]);
    query.set_end(i, end[static_cast<std::size_t>(i)]);
  }
  return rescaled(random, query);
}

/// F has two or three roots; neighbouring roots are 1 to 3 times 2^x apart. At one or more of the roots, the
/// points that coincide are inside the primitives; at the other roots, they are outside.
Query close_roots(Random& random, Kind kind, double x) {
  const double gap = power_of_two(x);
  const bool has_third = !random.one_in(3);
  double time = sixteenths(random, 0, 8);
  std::array<Factor, 3> factors{};
  for (Factor& factor : factors) {
    factor = Factor::vanishing_at(time);
    time += gap * random.integer(1, 3);
  }
  if (!has_third) factors[2] = Factor::constant();
  // One bit for each root: set if the contact at this root is inside the primitives. At least one bit is set.
  const int inside_at = random.integer(1, has_third ? 7 : 3);
  const Path base{random.integer_vector(64), random.integer_vector(64)};
  return with_drawn_roots(random, kind, base, [&] {
    std::array<PlannedRoot, 3> roots{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector direction = random.integer_vector(2);
      const bool is_inside = (inside_at >> i & 1) != 0;
      roots[i] = {factors[i], direction, is_inside ? inside(random, kind) : outside(random, kind)};
    }
    return roots;
  });
}

/// In two of three queries, the first contact is on the border of a primitive; in the others, it is in the
/// interiors of the primitives. The sides are parallel at a time 2^x before or after the first contact. The
/// second contact is in the interiors.
Query border_first(Random& random, Kind kind, double x) {
  const double first = sixteenths(random, 1, 12);
  const double second = first + sixteenths(random, 1, 3);
  const double parallel = first + random_sign(random) * power_of_two(x);
  const bool at_border = !random.one_in(3);
  const Path base{random.integer_vector(64), random.integer_vector(64)};
  return with_drawn_roots(random, kind, base, [&] {
    const auto root = [&](double time, const Weights& weights) {
      return PlannedRoot{Factor::vanishing_at(time), random.integer_vector(2), weights};
    };
    const Weights first_place = at_border ? border(random, kind) : inside(random, kind);
    const Weights second_place = inside(random, kind);
    const int alpha = random.integer(-2, 2);
    const int beta = random.integer(-2, 2);
    const PlannedRoot first_root = root(first, first_place);
    const PlannedRoot second_root = root(second, second_place);
    return std::array{first_root, second_root, root(parallel, {0, alpha, beta})};
  });
}

/// Contact at t = 0, or at t = 2^x / (1 + 2^x); then the primitives separate, and touch again later. At the
/// first contact, the points of contact pass each other along a coordinate axis. Nothing else moves along
/// this axis, so that the tiny numbers are exact.
Query return_later(Random& random, Kind kind, double x) {
  const Factor first{random.one_in(2) ? 0 : -power_of_two(x), 1};
  const double second = sixteenths(random, 4, 16);
  const bool has_third = random.one_in(2);
  const double third = sixteenths(random, 1, 3);
  const Vector axis = Vector::Unit(random.integer(0, 2));
  const Vector others = Vector::Ones() - axis;
  const auto across = [&](int size) -> Vector { return random.integer_vector(size).cwiseProduct(others); };
  const Vector start = across(64);
  const Vector end = across(64);
  return with_drawn_roots(random, kind, {start, end}, [&] {
    const bool is_border = random.one_in(4);
    const Weights first_place = is_border ? border(random, kind) : inside(random, kind);
    const Weights second_place = inside(random, kind);
    const Weights third_place = outside(random, kind);
    const Vector second_direction = across(2);
    const Vector third_direction = across(2);
    const double first_sign = random_sign(random);
    return std::array{PlannedRoot{first, first_sign * axis, first_place},
                      PlannedRoot{Factor::vanishing_at(second), second_direction, second_place},
                      PlannedRoot{has_third ? Factor::vanishing_at(third) : Factor::constant(),
                                  third_direction, third_place}};
  });
}

// --- touching at one time -------------------------------------------------------------------------------

/// Tangential contact. If the first primitive is moved a little along `inward`, the primitives meet at two
/// times near the contact; if it is moved the opposite way, they never meet.
struct Graze {
  Contact contact;
  Vector w;  ///< velocity of the first primitive's point of contact relative to the second primitive's
  Vector inward;
};

/// At the time of contact, the sides q and r lie in the plane z = 0. They leave this plane along z, with
/// velocities q' and r'. The first primitive moves as if its point of contact slid over the second primitive
/// with weights that change at the rates α' and β'. Let N = q × r, s = alpha_sign(kind) and c = β' r' + s α'
/// q'. If the first primitive is moved by δ along z, F is N_z (δ - c (t - time)²).
Graze graze_face(Random& random, Kind kind, double time) {
  for (;;) {
    const Vector q = vector_in_plane(random);
    const Vector r = vector_in_plane(random);
    const int q_velocity = random.integer(-4, 4);
    const int r_velocity = random.integer(-4, 4);
    const double alpha_rate = alpha_sign(kind) * random.integer(-4, 4);
    const int beta_rate = random.integer(-4, 4);
    const double curvature = beta_rate * r_velocity + alpha_rate * q_velocity;
    if (curvature == 0 || q.cross(r).isZero()) continue;
    const int eighths = random.integer(1, 6);
    const int others = random.integer(1, has_triangle(kind) ? 7 - eighths : 7);
    const Contact contact{.base = still(Vector::Zero()),
                          .q = passing(q, q_velocity * Vector::UnitZ(), time),
                          .r = passing(r, r_velocity * Vector::UnitZ(), time),
                          .alpha = eighths / 8.0,
                          .beta = others / 8.0,
                          .time = time};
    return {contact, beta_rate * r + alpha_rate * q, std::copysign(1, curvature) * Vector::UnitZ()};
  }
}

/// A vertex and an edge touch in the plane z = 0, in which everything moves. At the contact, the edge is
/// parallel to the x axis. The edge turns about the point of contact, and the vertex passes this point along
/// x, so it stays on one side of the edge. The fourth vertex is placed so that the primitives are apart at
/// all other times: it is the triangle's third vertex (vertex-triangle), or the other end of the edge that
/// the touching vertex belongs to (edge-edge).
Graze graze_edge(Random& random, Kind kind, double time) {
  const int length = random.integer(1, 4);
  const double turn = random_sign(random) * random.integer(1, 4);
  const double speed = random_sign(random) * random.integer(1, 4);
  const double side = std::copysign(1, turn * speed);  // the sign of y on the side away from the vertex
  const Path edge = passing(length * Vector::UnitX(), turn * Vector::UnitY(), time);
  const double away = alpha_sign(kind) * side * random.integer(1, 4);
  const Path multiple = scaled(edge, random.integer(-1, 1));
  const Path other{multiple.start + away * Vector::UnitY(), multiple.end + away * Vector::UnitY()};
  const double weight = random.integer(1, 7) / 8.0;
  const bool is_triangle = has_triangle(kind);
  const Contact contact{.base = still(Vector::Zero()),
                        .q = is_triangle ? edge : other,
                        .r = is_triangle ? other : edge,
                        .alpha = is_triangle ? weight : 0,
                        .beta = is_triangle ? 0 : weight,
                        .time = time};
  return {contact, speed * Vector::UnitX(), side * Vector::UnitY()};
}

/// In half of the queries, the primitives touch at one time only. The other queries are made in the same way,
/// but then the first primitive is moved by about 2^x, towards the second primitive or away from it.
Query touch_once(Random& random, Kind kind, double x) {
  const double time = sixteenths(random, 1, 15);
  auto [contact, w, inward] =
      random.one_in(3) ? graze_edge(random, kind, time) : graze_face(random, kind, time);
  const bool touches = random.one_in(2);
  const Vector shift =
      touches ? Vector(Vector::Zero()) : Vector(random_sign(random) * power_of_two(x) * inward);
  move_to_origin(kind, contact, random.integer_vector(4) - contact.velocity(kind));
  const Query query = with_first_moved(meet(kind, contact, contact.velocity(kind) + w), shift);
  return rescaled(random, turned(random, query));
}

// --- slow motion ----------------------------------------------------------------------------------------

/// Primitives of size 1 to 4 approach each other with a speed of about 2^x.
Query slow_contact(Random& random, Kind kind, double x) {
  const double time = sixteenths(random, 1, 15);
  const Contact contact = facing_contact(random, kind, draw_closest(random, kind), time);
  const Vector sideways = vector_in_plane(random);
  const Vector w = sideways - random.integer(1, 4) * Vector::UnitZ();
  return rescaled(random, turned(random, facing(kind, contact, power_of_two(x) * w, 0)));
}

}  // namespace

std::vector<Family> time_families() {
  return {
      with_collisions(
          with_parameter("close-roots", "two or three roots of F close together; the primitives meet at some",
                         {"neighbouring roots are 1 to 3 times 2^x apart", -40, -4, true, close_roots})),
      with_parameter("touch-once", "the primitives touch at one time, or pass each other by a tiny distance",
                     {"half of the queries are moved by about 2^x", -40, -8, true, touch_once}),
      with_collisions(with_parameter(
          "border-first", "contact of nearly degenerate primitives or on their border, then contact inside",
          {"time from the first contact to parallel sides = 2^x", -40, -5, true, border_first})),
      with_collisions(
          with_parameter("return-later", "contact at or right after t = 0, departure, and a second contact",
                         {"half of the first contacts are at about t = 2^x", -49, -10, true, return_later})),
      with_collisions(with_parameter(
          "slow-contact", "exact contact of primitives that hardly move",
          {"speed of the approach / size of the primitives = 2^x", -40, -10, true, slow_contact})),
  };
}

}  // namespace nearmiss
