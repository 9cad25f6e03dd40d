#include "fuzz/families/facing.hpp"

#include <cmath>

namespace nearmiss {

namespace {

using Vector = Vector3<double>;

constexpr int largest_coordinate = 4;

/// A vector that points away from the plane z = 0, upward if `level` is positive, otherwise downward.
Vector vector_away(Random& random, double level) {
  const Vector in_plane = vector_in_plane(random);
  return in_plane + level * random.integer(1, largest_coordinate) * Vector::UnitZ();
}

}  // namespace

Vector vector_in_plane(Random& random) {
  const int x = random.integer(-largest_coordinate, largest_coordinate);
  const int y = random.integer(-largest_coordinate, largest_coordinate);
  return {1.0 * x, 1.0 * y, 0};
}

Closest draw_closest(Random& random, Kind kind) {
  const Closest first = kind == Kind::vertex_vertex ? Closest::vertices
                        : kind == Kind::vertex_edge ? Closest::vertex_and_edge
                                                    : Closest::interiors;
  const Closest last = has_triangle(kind) ? Closest::vertices : Closest::parallel_edges;
  return static_cast<Closest>(random.integer(static_cast<int>(first), static_cast<int>(last)));
}

bool is_closest(Kind kind, Closest closest, bool is_side_q) {
  if (closest == Closest::vertices) return false;
  if (closest != Closest::vertex_and_edge) return true;
  return is_side_q == has_triangle(kind);
}

Contact facing_contact(Random& random, Kind kind, Closest closest, double time, double level) {
  const bool rests = random.one_in(2);
  // In a query with a triangle, q and r are sides of the triangle, which is the second primitive. In an
  // edge-edge query, q is the first edge, and r the second.
  const auto side = [&](bool is_q) {
    const double away = is_q && !has_triangle(kind) ? level : -level;
    const auto draw = [&] {
      return is_closest(kind, closest, is_q) ? vector_in_plane(random) : vector_away(random, away);
    };
    const Vector start = draw();
    return Path{start, rests ? start : draw()};
  };
  Contact contact{};
  contact.time = time;
  contact.q = side(true);
  contact.r = side(false);
  if (closest == Closest::parallel_edges) {
    const double sign = random.one_in(2) ? -1 : 1;
    contact.r = scaled(contact.q, std::ldexp(sign, random.integer(-1, 1)));
  }
  const int eighths = random.integer(1, 6);
  const int most = has_triangle(kind) && closest != Closest::vertex_and_edge ? 7 - eighths : 7;
  const int others = random.integer(1, most);
  contact.alpha = is_closest(kind, closest, true) ? eighths / 8.0 : 0;
  contact.beta = is_closest(kind, closest, false) ? others / 8.0 : 0;
  move_to_origin(kind, contact, random.integer_vector(random.one_in(2) ? 0 : largest_coordinate));
  return contact;
}

Query facing(Kind kind, const Contact& contact, const Vector& w, double gap) {
  return with_first_moved(meet(kind, contact, contact.velocity(kind) + w), gap * Vector::UnitZ());
}

}  // namespace nearmiss
