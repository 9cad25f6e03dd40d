#include "fuzz/families/mutation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fuzz/families/contacts.hpp"
#include "fuzz/families/place.hpp"

namespace nearmiss {

namespace {

using Vector = Vector3<double>;

// --- sizes and choices ------------------------------------------------------------------------------

int sign(Random& random) { return random.one_in(2) ? 1 : -1; }

double size_of(const Query& query) {
  const double size = extent(query);
  return size == 0 ? 1 : size;
}

/// The vertices first .. last: one random vertex, or all vertices of a primitive.
struct VertexRange {
  int first, last;
};

VertexRange some_vertices(Random& random, Kind kind) {
  const int one = random.integer(0, 3);
  if (random.one_in(2)) return {one, one};
  return one < split(kind) ? VertexRange{0, split(kind) - 1} : VertexRange{split(kind), 3};
}

Vector position(const Query& query, int point) {
  return point < 4 ? Vector(query.start(point)) : Vector(query.end(point - 4));
}

void set_position(Query& query, int point, const Vector& x) {
  if (point < 4)
    query.set_start(point, x);
  else
    query.set_end(point - 4, x);
}

/// Which positions of a vertex a mutation changes: the position at t = 0, the position at t = 1, or both.
struct Moments {
  bool start, end;
};

Moments some_moments(Random& random) {
  const int which = random.integer(0, 2);
  return {which != 0, which != 1};
}

// --- coordinates ------------------------------------------------------------------------------------

Query by_ulps(Random& random, const Query& query) {
  const int ulps = random.one_in(4) ? 64 : 4;
  return nudged(random, query, random.integer(1, 4), ulps);
}

/// Moves one position by a fraction of the distance between two positions, or moves all coordinates slightly.
Query by_a_fraction(Random& random, const Query& query) {
  const Vector from = position(query, random.integer(0, 7));
  const Vector to = position(query, random.integer(0, 7));
  const double distance = from == to ? size_of(query) : (to - from).norm();
  const double step = distance * random.log_uniform(random.one_in(2) ? 0x1p-8 : 0x1p-53, 1);
  Query result = query;
  if (random.one_in(4)) {
    for (double& c : result.x) c += step * random.uniform(-1, 1);
  } else {
    const int point = random.integer(0, 7);
    set_position(result, point, position(query, point) + random.vector(step));
  }
  return result;
}

/// Multiplies some coordinates by powers of two, or replaces them with zero or with a number at an end of the
/// range of double.
Query exponents(Random& random, const Query& query) {
  Query result = query;
  const std::array extremes{0.0, std::numeric_limits<double>::denorm_min(),
                            std::numeric_limits<double>::min(), std::numeric_limits<double>::max()};
  for (int count = random.integer(1, 3); count > 0; --count) {
    double& c = result.x[static_cast<std::size_t>(random.integer(0, 23))];
    const int up_or_down = sign(random);
    if (random.one_in(64))
      c = up_or_down * one_of(random, extremes);
    else
      c = std::ldexp(c, up_or_down * random.integer(1, random.one_in(4) ? 60 : 2));
  }
  return result;
}

/// Replaces some coordinates with other coordinates of the query, or with the negatives of such coordinates.
Query coordinate_copied(Random& random, const Query& query) {
  Query result = query;
  for (int count = random.integer(1, 3); count > 0; --count) {
    const auto to = static_cast<std::size_t>(random.integer(0, 23));
    const auto other = static_cast<std::size_t>(random.integer(0, 23));
    const std::size_t from = random.one_in(4) ? other : other - other % 3 + to % 3;
    result.x[to] = sign(random) * result.x[from];
  }
  return result;
}

/// Rounds all coordinates, or those of one position, to integer multiples of a power of two. The integers
/// have at most 6 bits or, in one of four queries, at most 30 bits.
Query rounded(Random& random, const Query& query) {
  double largest = 0;
  for (const double c : query.x) largest = std::max(largest, std::abs(c));
  int exponent = 0;
  std::frexp(largest, &exponent);
  const double unit = std::ldexp(1, exponent - random.integer(1, random.one_in(4) ? 30 : 6));
  const auto one = static_cast<std::size_t>(random.integer(0, 7));
  const bool all = random.one_in(2);
  Query result = query;
  for (std::size_t i = 0; i < 24; ++i)
    if (all || i / 3 == one) result.x[i] = std::nearbyint(query.x[i] / unit) * unit;
  return result;
}

// --- contact ----------------------------------------------------------------------------------------

Query joined_somehow(Random& random, const Query& query, const Place& place) {
  return joined(query, place, one_of(random, movable_points(query.kind, place)));
}

/// Moves a position so that the primitives touch at a random place.
Query planted(Random& random, const Query& query) {
  return joined_somehow(random, query, random_place(random, query.kind));
}

/// Moves a position of a vertex so that the primitives touch at the place where, before this move, they
/// nearly touch.
Query restored(Random& random, const Query& query) {
  return joined_somehow(random, query, own_place(random, query));
}

Place anywhere_in_planes(Random& random) {
  const double alpha = random.one_in(2) ? random.integer(-2, 3) : random.uniform(-2, 3);
  const double beta = random.one_in(2) ? random.integer(-2, 3) : random.uniform(-2, 3);
  return {alpha, beta, random.uniform()};
}

/// Moves a position so that all vertices are in one plane at some time.
Query coplanar_once(Random& random, const Query& query) {
  Place place = anywhere_in_planes(random);
  if (random.one_in(2)) place.time = random.integer(0, 16) / 16.0;
  return joined_somehow(random, query, place);
}

/// Keeps all vertices in one plane during the whole step. Either both positions of one vertex are moved, so
/// that the two points of a Place coincide at all times; or all vertices are moved into one plane normal to
/// an axis.
Query coplanar_always(Random& random, const Query& query) {
  if (random.one_in(2)) {
    Query result = query;
    const auto axis = static_cast<std::size_t>(random.integer(0, 2));
    const double level = query.x[3 * static_cast<std::size_t>(random.integer(0, 7)) + axis];
    for (std::size_t i = 0; i < 8; ++i) result.x[3 * i + axis] = level;
    return result;
  }
  Place place = random.one_in(2) ? anywhere_in_planes(random) : random_place(random, query.kind);
  place.time = 0;
  const int point = one_of(random, movable_points(query.kind, place));
  const Query start = joined(query, place, point);
  place.time = 1;
  return joined(start, place, 4 + point);
}

// --- primitives and motion -----------------------------------------------------------------------------

/// Multiplies the distance between two vertices by a factor below 1, often by 0.
Query edge_shrunk(Random& random, const Query& query) {
  const int fixed = random.integer(0, 3);
  const int moving = (fixed + random.integer(1, 3)) % 4;
  const double factor = random.one_in(3) ? 0 : random.log_uniform(0x1p-52, 1);
  const auto nearer = [&](const Vector& x, const Vector& to) -> Vector { return to + factor * (x - to); };
  const Moments moments = some_moments(random);
  Query result = query;
  if (moments.start) result.set_start(moving, nearer(query.start(moving), query.start(fixed)));
  if (moments.end) result.set_end(moving, nearer(query.end(moving), query.end(fixed)));
  return result;
}

/// A velocity: zero; the velocity of a vertex; a multiple of the vector from one vertex to another; or the
/// sum of two such multiples with the same first vertex.
Vector aligned_velocity(Random& random, const Query& query) {
  const int base = random.integer(0, 3);
  switch (random.integer(0, 3)) {
    case 0:
      return Vector::Zero();
    case 1:
      return query.end(base) - query.start(base);
    default: {
      const auto multiple = [&](int vertex) -> Vector {
        const double factor = random.one_in(2) ? 1 : random.log_uniform(0x1p-30, 4);
        return sign(random) * factor * (query.start(vertex) - query.start(base));
      };
      const Vector along = multiple((base + 1) % 4);
      return random.one_in(2) ? along : along + multiple((base + 2) % 4);
    }
  }
}

Query velocity_aligned(Random& random, const Query& query) {
  const Vector velocity = aligned_velocity(random, query);
  const VertexRange vertices = some_vertices(random, query.kind);
  const bool backwards = random.one_in(2);
  Query result = query;
  for (int i = vertices.first; i <= vertices.last; ++i) {
    if (backwards)
      result.set_start(i, query.end(i) - velocity);
    else
      result.set_end(i, query.start(i) + velocity);
  }
  return result;
}

Query vertex_copied(Random& random, const Query& query) {
  const int from = random.integer(0, 3);
  const int to = (from + random.integer(1, 3)) % 4;
  const Moments moments = some_moments(random);
  Query result = query;
  if (moments.start) result.set_start(to, query.start(from));
  if (moments.end) result.set_end(to, query.end(from));
  return result;
}

/// Exchanges the start and the end of all vertices, of the vertices of a primitive, or of one vertex.
Query reversed(Random& random, const Query& query) {
  const VertexRange vertices = random.one_in(2) ? VertexRange{0, 3} : some_vertices(random, query.kind);
  Query result = query;
  for (int i = vertices.first; i <= vertices.last; ++i) {
    result.set_start(i, query.end(i));
    result.set_end(i, query.start(i));
  }
  return result;
}

// --- the whole --------------------------------------------------------------------------------------

Query scaled(Random& random, const Query& query) {
  const int exponent = random.one_in(4) ? random.integer(-1000, 1000) : random.integer(-20, 20);
  Query result = query;
  for (double& c : result.x) c = std::ldexp(c, exponent);
  result.separation = std::ldexp(query.separation, exponent);
  return result;
}

Query translated(Random& random, const Query& query) {
  const Vector offset = random.one_in(4)
                            ? Vector(-position(query, random.integer(0, 7)))
                            : random.vector(size_of(query) * random.log_uniform(0x1p-20, 0x1p40));
  Query result = query;
  for (int i = 0; i < 8; ++i) set_position(result, i, position(query, i) + offset);
  return result;
}

using Apply = Query (*)(Random& random, const Query& query);

constexpr std::array<Apply, 16> mutations{by_ulps,         by_a_fraction, exponents,        coordinate_copied,
                                          rounded,         planted,       restored,         coplanar_once,
                                          coplanar_always, edge_shrunk,   velocity_aligned, vertex_copied,
                                          reversed,        scaled,        translated,       shuffled};

Query applied(Apply apply, Random& random, const Query& query) {
  const Query result = apply(random, query);
  return is_finite(result) && std::isfinite(result.separation) ? result : query;
}

/// Changes a separation h > 0 by a fraction, multiplies or divides it by a power of two, or rounds it down to
/// a power of two.
Query separation_changed(Random& random, const Query& query) {
  const double h = query.separation;
  switch (random.integer(0, 2)) {
    case 0: {
      const double fraction = random.log_uniform(0x1p-53, 1);
      return with_separation(query, h + fraction * h * random.uniform(-1, 1));
    }
    case 1: {
      const int up_or_down = sign(random);
      return with_separation(query, std::ldexp(h, up_or_down * random.integer(1, 8)));
    }
    default:
      return with_separation(query, std::ldexp(1, std::ilogb(h)));
  }
}

}  // namespace

Query mutated(Random& random, const Query& query) {
  Query result = query;
  do {
    for (int count = random.integer(1, 3); count > 0; --count)
      result = applied(random.one_in(2) ? by_a_fraction : one_of(random, mutations), random, result);
    if (random.one_in(2)) result = applied(restored, random, result);
    if (result.separation > 0 && random.one_in(4)) result = applied(separation_changed, random, result);
  } while (result == query);
  return result;
}

Query crossed(Random& random, const Query& first, const Query& second) {
  Query result{.kind = random.one_in(2) ? first.kind : second.kind};
  const std::uint64_t choices = random.bits();
  const int parts = random.integer(0, 3);
  for (std::size_t i = 0; i < 24; ++i) {
    const std::array part{i / 3 % 4, i % 3, i / 12, i};  // vertex, axis, moment, coordinate
    const bool from_first = (choices >> part[static_cast<std::size_t>(parts)] & 1) != 0;
    result.x[i] = (from_first ? first : second).x[i];
  }
  result.separation = (choices >> 24 & 1) != 0 ? first.separation : second.separation;
  return result;
}

}  // namespace nearmiss
