// Coordinates as files and simulations have them: floats, decimals, and small primitives in large scenes. x
// is the family's parameter.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "fuzz/families/contacts.hpp"
#include "fuzz/families/tables.hpp"

namespace nearmiss {

namespace {

using Vector = Vector3<double>;

/// Primitives of the given size and speed, in general position around the origin. They are aimed at each
/// other, but the place where their planes or lines meet may be outside the primitives, and the time at which
/// they meet may be outside the step.
Query everyday(Random& random, Kind kind, double size, double speed) {
  const auto path = [&](double length) {
    const Vector start = random.vector(length);
    return Path{start, start + random.vector(speed)};
  };
  Contact contact;
  contact.base = path(0);
  contact.q = path(size);
  contact.r = path(size);
  contact.alpha = random.uniform(-0.25, 1);
  contact.beta = random.uniform(-0.25, has_triangle(kind) ? 1 - contact.alpha : 1.25);
  contact.time = random.uniform(-0.25, 1.25);
  return shuffled(random, meet(kind, contact, random.vector(speed)));
}

/// Primitives of size 1 in a scene of size 10; all coordinates are floats.
Query floats(Random& random, Kind kind) {
  const double speed = power_of_ten(random.uniform(-3, 0));
  Query query = everyday(random, kind, 1, speed);
  query = moved(query, random.vector(10));
  for (double& c : query.x) c = static_cast<double>(static_cast<float>(c));
  return query;
}

/// Decimals with x digits behind the point, rounded to the nearest doubles. In half of the queries, the
/// primitives touch exactly before the decimals are rounded; after the rounding, the primitives touch or are
/// a few ulps apart.
Query decimals(Random& random, Kind kind, double x) {
  const int unit = static_cast<int>(std::lround(std::pow(10.0, x)));
  Query query{.kind = kind};
  if (random.one_in(2)) {
    for (std::size_t i = 0; i < 12; ++i) query.x[i] = random.integer(-unit, unit);
    for (std::size_t i = 12; i < 24; ++i) query.x[i] = query.x[i - 12] + random.integer(-unit / 2, unit / 2);
  } else {
    // Sides and velocities are multiples of 100 / 10^x, and weights and times are multiples of 1/10. So all
    // coordinates have x digits behind the point.
    const int most = std::max(unit / 100, 1);
    const auto hundreds = [&]() -> Vector { return 100 * random.integer_vector(most); };
    const auto path = [&]() {
      const Vector start = hundreds();
      return Path{start, start + hundreds()};
    };
    Contact contact;
    contact.base = path();
    contact.q = path();
    contact.r = path();
    const int tenths = random.integer(0, 10);
    contact.alpha = tenths / 10.0;
    contact.beta = random.integer(0, has_triangle(kind) ? 10 - tenths : 10) / 10.0;
    contact.time = random.integer(0, 10) / 10.0;
    query = meet(kind, contact, hundreds());
    query = moved(query, random.integer_vector(10 * unit));
  }
  for (double& c : query.x) c = std::round(c) / unit;
  return shuffled(random, query);
}

/// Primitives of 1 mm to 10 cm in a scene of up to 10 km; the unit is a metre.
Query kilometres(Random& random, Kind kind) {
  const double size = power_of_ten(random.uniform(-3, -1));
  const double faster = power_of_ten(random.uniform(-2, 1));
  const double speed = size * faster;
  const Query query = everyday(random, kind, size, speed);
  const double scene = random.one_in(4) ? 10000 : 1000;
  return moved(query, random.vector(scene));
}

// The values of the factors of `metres`. Lengths of edges and sizes of scenes are in metres. The length of a
// motion is in multiples of an edge length.
constexpr std::array edges{1e-3, 1e-2, 1e-1, 1.0};
constexpr std::array steps{1e-4, 1e-3, 1e-2, 1e-1, 1.0};
constexpr std::array scenes{1.0, 10.0, 100.0};

struct Metres {
  double edge, step, scene;

  explicit Metres(Random& random)
      : edge(one_of(random, edges)), step(one_of(random, steps)), scene(one_of(random, scenes)) {}
};

Query metres(Random& random, Kind kind) {
  const Metres of(random);
  const Query query = everyday(random, kind, of.edge, of.step * of.edge);
  return moved(query, random.vector(of.scene));
}

std::vector<std::string> factors_of_metres(Random& random) {
  const Metres of(random);
  return {fmt::format("edge={}", of.edge), fmt::format("step={}", of.step),
          fmt::format("scene={}", of.scene)};
}

/// A query of everyday() with size 1 and a speed from 1e-4 to 1.
Query everyday_of_size_1(Random& random, Kind kind) {
  const double speed = power_of_ten(random.uniform(-4, 0));
  return everyday(random, kind, 1, speed);
}

/// A query of everyday_of_size_1(), with all coordinates multiplied by 2^x.
Query units(Random& random, Kind kind, double x) {
  Query query = everyday_of_size_1(random, kind);
  for (double& c : query.x) c = std::ldexp(c, static_cast<int>(x));
  return query;
}

/// A query of everyday_of_size_1(), moved away from the origin. The translation is exact: all coordinates are
/// multiples of 2^-22 below 2^28.
Query distant(Random& random, Kind kind, double x) {
  constexpr double grid = 0x1p-22;
  const auto on_grid = [](double c) { return grid * std::round(c / grid); };
  Query query = everyday_of_size_1(random, kind);
  for (double& c : query.x) c = on_grid(c);
  const Vector direction = random.vector(1).unaryExpr(on_grid);
  return moved(query, power_of_two(x) * direction);
}

}  // namespace

std::vector<Family> file_families() {
  return {
      {.name = "floats", .about = "coordinates are floats, as in many mesh files", .make = floats},
      with_parameter("decimals", "coordinates are decimals, as in text files",
                     {"digits behind the point = x", 1, 6, true, decimals}),
      {.name = "kilometres",
       .about = "primitives of millimetres in a scene of kilometres",
       .make = kilometres},
      {.name = "metres",
       .about = "edges of 1 mm to 1 m, in scenes of 1 m to 100 m, in steps of 1e-4 to 1 edges",
       .make = metres,
       .factors = factors_of_metres},
      with_parameter("units", "the same pairs in other units: all coordinates are multiplied by 2^x",
                     {"length of the edges = about 2^x", -30, 30, true, units, "edge"}),
      with_parameter(
          "distant", "the same pairs far from the origin",
          {"distance from the origin / length of the edges = about 2^x", 0, 26, true, distant, "distance"}),
  };
}

}  // namespace nearmiss
