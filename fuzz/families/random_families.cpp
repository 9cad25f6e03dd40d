// Random queries, exact collisions, and the cases that Wang's paper names: parallel, small, thin and planar
// primitives.
#include <algorithm>

#include "fuzz/families/contacts.hpp"
#include "fuzz/families/tables.hpp"

namespace nearmiss {

namespace {

using Vector = Vector3<double>;

// --- the paper's random cube, §5 ---------------------------------------------------------------------

Query cube(Random& random, Kind kind, double speed) {
  Query query{.kind = kind};
  const auto drawn = random.uniforms<24>();
  for (std::size_t i = 0; i < 12; ++i) {
    query.x[i] = drawn[i];
    query.x[12 + i] = drawn[i] + (-speed + 2 * speed * drawn[12 + i]);
  }
  return query;
}

Query uniform(Random& random, Kind kind) { return cube(random, kind, 1); }
Query uniform_slow(Random& random, Kind kind) { return cube(random, kind, 0.01); }

Query uniform_end(Random& random, Kind kind) {
  Query query{.kind = kind};
  const auto drawn = random.uniforms<24>();
  std::copy(drawn.begin(), drawn.end(), query.x.begin());
  return query;
}

// --- exact collisions -------------------------------------------------------------------------------

Query planted(Random& random, Kind kind) {
  const Contact contact = integer_contact(random, kind);
  return placed(random, meet(kind, contact, random.integer_vector(1 << random.integer(0, 16))));
}

Query planted_ulp(Random& random, Kind kind) {
  const Query query = planted(random, kind);
  const int most = random.one_in(4) ? 64 : 4;
  return nudged(random, query, random.integer(1, 4), most);
}

/// A contact at which F, the coplanarity cubic, and its derivative F' vanish, because the relative velocity
/// of the touching points lies in the plane that contains both primitives at that time.
Query grazing(Random& random, Kind kind) {
  Contact contact = integer_contact(random, kind);
  const Vector along_r = random.integer(-4, 4) / 4.0 * contact.r.at(contact.time);
  const Vector in_plane = random.integer(-4, 4) / 4.0 * contact.q.at(contact.time) + along_r;
  const Query query = placed(random, meet(kind, contact, contact.velocity(kind) + in_plane));
  return random.one_in(2) ? query : nudged(random, query, random.integer(1, 4), 16);
}

// --- nearly degenerate contact, in floating point ---------------------------------------------------

/// Primitives of size 1 that are aimed at each other. In half of the contacts, the place may be slightly
/// outside the primitives, and the time slightly outside the step.
Contact aimed_contact(Random& random, Kind kind) {
  const auto path = [&](double size, double speed) {
    const Vector start = random.vector(size);
    return Path{start, start + random.vector(speed)};
  };
  const double speed = random.log_uniform(1e-3, 2);
  Contact contact;
  contact.base = path(1, speed);
  contact.q = path(1, random.uniform() * speed);
  contact.r = path(1, random.uniform() * speed);
  const double margin = random.one_in(2) ? 0 : random.log_uniform(1e-9, 0.3);
  contact.alpha = random.uniform(-margin, 1 + margin);
  contact.beta = random.uniform(-margin, 1 + margin);
  if (has_triangle(kind) && contact.alpha + contact.beta > 1) {
    contact.alpha = 1 - contact.alpha;
    contact.beta = 1 - contact.beta;
  }
  contact.time = random.uniform(-margin, 1 + margin);
  return contact;
}

/// The relative motion is nearly in the primitives' plane (in the paper: parallel motion, §3.3; motion
/// perpendicular to N = q × r, §3.4).
Query parallel(Random& random, Kind kind) {
  const Contact contact = aimed_contact(random, kind);
  const Vector along_r = random.uniform(-2, 2) * contact.r.at(contact.time);
  const Vector in_plane = random.uniform(-2, 2) * contact.q.at(contact.time) + along_r;
  const Vector out_of_plane = random.vector(random.log_uniform(1e-16, 1e-2));
  return shuffled(random, meet(kind, contact, contact.velocity(kind) + in_plane + out_of_plane));
}

/// Primitives far smaller than their motion (in the paper: small triangle, §3.3; small quadrilateral, §3.4).
Query small(Random& random, Kind kind) {
  Contact contact = aimed_contact(random, kind);
  const double size = random.log_uniform(1e-12, 1e-2);
  contact.q = scaled(contact.q, size);
  contact.r = scaled(contact.r, random.one_in(2) ? size : random.log_uniform(1e-12, 1));
  return shuffled(random, meet(kind, contact, random.vector(1)));
}

/// Thin triangles and nearly parallel edges: r is a multiple of q plus a small vector.
Query sliver(Random& random, Kind kind) {
  Contact contact = aimed_contact(random, kind);
  const double along = random.uniform(-1.5, 1.5);
  const double across = random.log_uniform(1e-16, 1e-2);
  contact.r = {along * contact.q.start + random.vector(across),
               along * contact.q.end + random.vector(across)};
  return shuffled(random, meet(kind, contact, random.vector(1)));
}

// --- F is zero identically --------------------------------------------------------------------------

/// The vertices stay exactly in one plane: every position is a P + b Q + O with integers a and b. All
/// coordinates are integers below 2^31.
Query planar(Random& random, Kind kind) {
  const Vector P = random.integer_vector(8);
  const Vector Q = random.integer_vector(8);
  const Vector O = random.integer_vector(random.one_in(2) ? 0 : 1 << 12);
  const int size = 1 << random.integer(2, 20);
  Query query{.kind = kind};
  for (int i = 0; i < 4; ++i) {
    const auto point = [&]() -> Vector {
      const Vector along_Q = random.integer(-size, size) * Q;
      return random.integer(-size, size) * P + along_Q + O;
    };
    query.set_start(i, point());
    query.set_end(i, point());
  }
  return query;
}

// --- coincidences -----------------------------------------------------------------------------------

/// All coordinates are small integers; some points coincide, and some points are at rest.
Query degenerate(Random& random, Kind kind) {
  const int size = random.integer(1, 3);
  Query query{.kind = kind};
  for (double& c : query.x) c = random.integer(-size, size);
  for (int copies = random.integer(0, 3); copies > 0; --copies) {
    const int from = random.integer(0, 3);
    const int to = random.integer(0, 3);
    const Vector start = query.start(from);
    const Vector end = query.end(from);
    switch (random.integer(0, 3)) {
      case 0:
        query.set_start(to, start);
        break;
      case 1:
        query.set_end(to, end);
        break;
      case 2:
        query.set_start(to, start);
        query.set_end(to, end);
        break;
      default:
        query.set_end(to, query.start(to));
    }
  }
  const double scale = random.one_in(2) ? 1 : random.log_uniform(1e-3, 1e3);
  for (double& c : query.x) c *= scale;
  return query;
}

/// Every coordinate is an integer in -most .. most, so coincidences of all sorts occur.
template <int most>
Query small_integer(Random& random, Kind kind) {
  Query query{.kind = kind};
  for (double& c : query.x) c = random.integer(-most, most);
  return query;
}

Family plain(std::string name, std::string about, Query (*make)(Random&, Kind), bool is_planted = false) {
  return {std::move(name), std::move(about), is_planted, make, std::nullopt};
}

}  // namespace

std::vector<Family> random_families() {
  return {
      plain("uniform", "start uniform in the unit cube, velocity in [-1, 1]^3: the paper's random test",
            uniform),
      plain("uniform-end", "start and end uniform in the unit cube", uniform_end),
      plain("uniform-slow", "start uniform in the unit cube, velocity in [-0.01, 0.01]^3", uniform_slow),
      plain("planted", "exact collisions by construction: inside, on edges, in vertices, at t = 0 and t = 1",
            planted, true),
      plain("planted-ulp", "planted collisions with a few coordinates moved by ulps", planted_ulp),
      plain("grazing", "tangential contact: a double root, exact or up to a few ulps", grazing),
      plain("parallel", "relative motion nearly in the plane of the primitives", parallel),
      plain("small", "primitives down to 1e-12 of their motion", small),
      plain("sliver", "thin triangles and nearly parallel edges", sliver),
      plain("planar", "everything stays in one plane: F is zero identically", planar),
      plain("small-integer", "coordinates are integers in -3 .. 3: touching, coplanar, coincident",
            small_integer<3>),
      plain("unit-integer", "coordinates are -1, 0 or 1: most queries touch or are degenerate",
            small_integer<1>),
      plain("degenerate", "small integers with coincident points and points at rest", degenerate),
  };
}

}  // namespace nearmiss
