#include "fuzz/families.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "ccd/error.hpp"
#include "fuzz/figures.hpp"

namespace nearmiss {

namespace {

using Vector = Vector3<double>;

// --- the paper's random cube, §5 ---------------------------------------------------------------------

Query cube(Random& random, Kind kind, double speed) {
  Query query{.kind = kind};
  for (std::size_t i = 0; i < 12; ++i) query.x[i] = random.uniform();
  for (std::size_t i = 0; i < 12; ++i) query.x[12 + i] = query.x[i] + random.uniform(-speed, speed);
  return query;
}

Query uniform(Random& random, Kind kind) { return cube(random, kind, 1); }
Query uniform_slow(Random& random, Kind kind) { return cube(random, kind, 0.01); }

Query uniform_end(Random& random, Kind kind) {
  Query query{.kind = kind};
  for (double& c : query.x) c = random.uniform();
  return query;
}

// --- exact collisions -------------------------------------------------------------------------------

/// Figures on an integer grid, with weights and time that are multiples of 1/16: sums of at most three
/// products of a number below 2^20 with two such multiples have at most 20 + 8 + 3 bits, far below 53.
Contact integer_contact(Random& random, Kind kind) {
  const auto path = [&](int bits, int velocity_bits) {
    const Vector start = random.integer_vector((1 << bits) - 1);
    return Path{start, start + random.integer_vector((1 << velocity_bits) - 1)};
  };
  const int size = random.integer(1, 16);
  const int speed = random.integer(0, 16);
  Contact contact;
  contact.base = path(random.integer(0, 18), speed);
  contact.q = path(size, random.integer(0, speed));
  contact.r = path(random.one_in(4) ? random.integer(1, 16) : size, random.integer(0, speed));

  const auto weight = [&](int most) { return random.integer(0, most) / 16.0; };
  contact.alpha = random.one_in(4) ? 0 : weight(16);
  const int left = kind == Kind::vertex_triangle ? 16 - static_cast<int>(16 * contact.alpha) : 16;
  const int place = random.integer(0, 7);
  contact.beta = place == 0 ? 0 : place == 1 ? left / 16.0 : weight(left);

  const int moment = random.integer(0, 7);
  contact.time = moment == 0 ? 0 : moment == 1 ? 1 : weight(16);
  return contact;
}

/// Scales by a power of two, exactly, and moves by an integer vector first, now and then.
Query placed(Random& random, Query query) {
  if (random.one_in(4)) {
    const Vector offset = random.integer_vector(1 << 20);
    for (std::size_t i = 0; i < 24; ++i) query.x[i] += offset[static_cast<int>(i % 3)];
  }
  const double scale = std::ldexp(1.0, random.integer(-40, 20));
  for (double& c : query.x) c *= scale;
  return shuffled(random, query);
}

Query planted(Random& random, Kind kind) {
  const Contact contact = integer_contact(random, kind);
  return placed(random, meet(kind, contact, random.integer_vector(1 << random.integer(0, 16))));
}

Query planted_ulp(Random& random, Kind kind) {
  const Query query = planted(random, kind);
  return nudged(random, query, random.integer(1, 4), random.one_in(4) ? 64 : 4);
}

/// A contact at which F' vanishes too: the relative velocity of the touching points lies in the common plane.
Query grazing(Random& random, Kind kind) {
  Contact contact = integer_contact(random, kind);
  const Vector in_plane = random.integer(-4, 4) / 4.0 * contact.q.at(contact.time) +
                          random.integer(-4, 4) / 4.0 * contact.r.at(contact.time);
  const Query query = placed(random, meet(kind, contact, contact.velocity(kind) + in_plane));
  return random.one_in(2) ? query : nudged(random, query, random.integer(1, 4), 16);
}

// --- nearly degenerate contact, in floating point ---------------------------------------------------

/// Unit figures aimed at each other, at a place that is outside of them now and then.
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
  if (kind == Kind::vertex_triangle && contact.alpha + contact.beta > 1) {
    contact.alpha = 1 - contact.alpha;
    contact.beta = 1 - contact.beta;
  }
  contact.time = random.uniform(-margin, 1 + margin);
  return contact;
}

Path scaled(const Path& path, double factor) { return {factor * path.start, factor * path.end}; }

/// The relative motion is nearly in the plane of the figures (§3.3, parallel motion; §3.4, perpendicular to
/// N).
Query parallel(Random& random, Kind kind) {
  const Contact contact = aimed_contact(random, kind);
  const Vector in_plane =
      random.uniform(-2, 2) * contact.q.at(contact.time) + random.uniform(-2, 2) * contact.r.at(contact.time);
  const Vector out_of_plane = random.vector(random.log_uniform(1e-16, 1e-2));
  return shuffled(random, meet(kind, contact, contact.velocity(kind) + in_plane + out_of_plane));
}

/// Figures far smaller than their motion (§3.3, small triangle; §3.4, small quadrilateral).
Query small(Random& random, Kind kind) {
  Contact contact = aimed_contact(random, kind);
  const double size = random.log_uniform(1e-12, 1e-2);
  contact.q = scaled(contact.q, size);
  contact.r = scaled(contact.r, random.one_in(2) ? size : random.log_uniform(1e-12, 1));
  return shuffled(random, meet(kind, contact, random.vector(1)));
}

/// Thin triangles and nearly parallel edges: r is a multiple of q but for a small part.
Query sliver(Random& random, Kind kind) {
  Contact contact = aimed_contact(random, kind);
  const double along = random.uniform(-1.5, 1.5);
  const double across = random.log_uniform(1e-16, 1e-2);
  contact.r = {along * contact.q.start + random.vector(across),
               along * contact.q.end + random.vector(across)};
  return shuffled(random, meet(kind, contact, random.vector(1)));
}

// --- F is zero identically --------------------------------------------------------------------------

/// All points stay in one plane through integer points, exactly: a P + b Q + O with integers that keep within
/// 2^31.
Query planar(Random& random, Kind kind) {
  const Vector P = random.integer_vector(8);
  const Vector Q = random.integer_vector(8);
  const Vector O = random.integer_vector(random.one_in(2) ? 0 : 1 << 12);
  const int size = 1 << random.integer(2, 20);
  Query query{.kind = kind};
  for (int i = 0; i < 4; ++i) {
    const auto point = [&]() -> Vector {
      return random.integer(-size, size) * P + random.integer(-size, size) * Q + O;
    };
    query.set_start(i, point());
    query.set_end(i, point());
  }
  return query;
}

// --- coincidences -----------------------------------------------------------------------------------

/// Small integers, with points copied from each other and points that rest.
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

/// Every coordinate an integer in -3 .. 3: coincidences of all sorts.
Query small_integer(Random& random, Kind kind) {
  Query query{.kind = kind};
  for (double& c : query.x) c = random.integer(-3, 3);
  return query;
}

constexpr std::array table{
    Family{"uniform", "start uniform in the unit cube, velocity in [-1, 1]^3: the paper's random test", false,
           uniform},
    Family{"uniform-end", "start and end uniform in the unit cube", false, uniform_end},
    Family{"uniform-slow", "start uniform in the unit cube, velocity in [-0.01, 0.01]^3", false,
           uniform_slow},
    Family{"planted", "exact collisions by construction: inside, on edges, in vertices, at t = 0 and t = 1",
           true, planted},
    Family{"planted-ulp", "planted collisions with a few coordinates moved by ulps", false, planted_ulp},
    Family{"grazing", "tangential contact: a double root, exactly or but for ulps", false, grazing},
    Family{"parallel", "relative motion nearly in the plane of the figures", false, parallel},
    Family{"small", "figures down to 1e-12 of their motion", false, small},
    Family{"sliver", "thin triangles and nearly parallel edges", false, sliver},
    Family{"planar", "everything stays in one plane: F is zero identically", false, planar},
    Family{"small-integer", "coordinates are integers in -3 .. 3: touching, coplanar, coincident", false,
           small_integer},
    Family{"degenerate", "small integers with coincident points and points at rest", false, degenerate},
};

}  // namespace

std::span<const Family> families() { return table; }

const Family& find_family(std::string_view name) {
  std::string known;
  for (const Family& family : table) {
    if (family.name == name) return family;
    known += (known.empty() ? "" : ", ") + std::string(family.name);
  }
  throw Error("unknown family '" + std::string(name) + "', expected all or some of " + known);
}

Query make_query(const Family& family, std::uint64_t seed, std::uint64_t index) {
  // The stream is a hash of the name, so that a family's queries stay when the list changes (FNV-1a).
  std::uint64_t stream = 0xcbf29ce484222325;
  for (const char c : family.name) stream = (stream ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  Random random(seed, stream, index);
  return family.make(random, kinds[index % 2]);
}

}  // namespace nearmiss
