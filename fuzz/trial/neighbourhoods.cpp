#include "fuzz/trial/neighbourhoods.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace nearmiss {

namespace {

constexpr std::size_t separation = 24;  // the index of the separation among Numbers

/// The path of a vertex along axis k consists of two coordinates. Returns the index of the coordinate at t =
/// 0. The index of the coordinate at t = 1 is larger by 12.
constexpr std::size_t path(std::size_t vertex, std::size_t k) { return 3 * vertex + k; }
constexpr std::size_t paths = 12;
constexpr std::array<std::size_t, 2> times{0, paths};

/// A set of numbers: bit i stands for number i.
using Set = std::uint32_t;
constexpr Set only(std::size_t i) { return Set{1} << i; }
constexpr Set path_set(std::size_t i) { return only(i) | only(paths + i); }
constexpr Set axis_set(std::size_t k) { return 0x249249U << k; }
constexpr Set vertex_set(std::size_t vertex) { return 0x7007U << path(vertex, 0); }
constexpr Set everything = 0x1ffffffU;

std::vector<double> magnitudes_in(Set set, const Numbers& x) {
  std::vector<double> some;
  for (std::size_t i = 0; i < x.size(); ++i)
    if ((set & only(i)) != 0) some.push_back(x[i]);
  return magnitudes(some);
}

template <class Function>
void replace(Numbers& x, Set set, const Function& function) {
  for (std::size_t i = 0; i < x.size(); ++i)
    if ((set & only(i)) != 0) x[i] = function(x[i]);
}

/// Subtracts numbers from the coordinates of all vertices along axis k, at t = 0 and t = 1.
void subtract(Numbers& x, std::size_t k, double of_start, double of_end) {
  for (std::size_t v = 0; v < 4; ++v) {
    x[path(v, k)] -= of_start;
    x[paths + path(v, k)] -= of_end;
  }
}

void exchange(Numbers& x, std::size_t v, std::size_t w) {
  for (double* start : {x.data(), x.data() + paths})
    std::swap_ranges(start + 3 * v, start + 3 * v + 3, start + 3 * w);
}

/// Scales all numbers together or, if `each_axis` is true, the coordinates along each axis by themselves.
/// After scaling, their largest magnitude is in [2^exponent, 2^(exponent + 1)). Then rounds the scaled
/// numbers to integers. The separation is scaled only together with all coordinates. If it is positive, it
/// becomes at least 1, because a query with h = 0 would ask for contact, which is another question.
void round(Numbers& x, int exponent, bool each_axis) {
  const bool has_separation = x[separation] != 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Set set = each_axis ? axis_set(k) : everything;
    const auto all = magnitudes_in(set, x);
    if (all.empty()) continue;
    const int up = exponent - std::ilogb(all.back());
    replace(x, set, [&](double c) { return std::nearbyint(std::ldexp(c, up)); });
    if (each_axis) continue;
    if (has_separation) x[separation] = std::max(x[separation], 1.0);
    return;
  }
}

/// Moves nothing, or moves all vertices so that one of them is at the origin at t = 0 or at all times. Then
/// scales the query by powers of two, and rounds all coordinates to integers of at most 7 bits.
Neighbourhood round_all(const Numbers& /*x*/) {
  Neighbourhood changes;
  for (const int exponent : {0, 1, 2, 3, 4, 6})
    for (const bool each_axis : {false, true}) {
      changes.push_back({[=](Numbers& x) { round(x, exponent, each_axis); }});
      for (std::size_t vertex = 0; vertex < 4; ++vertex)
        for (const std::size_t end : times)
          changes.push_back({[=](Numbers& x) {
            for (std::size_t k = 0; k < 3; ++k) subtract(x, k, x[path(vertex, k)], x[end + path(vertex, k)]);
            round(x, exponent, each_axis);
          }});
    }
  return changes;
}

/// Sets all coordinates along an axis to 0, or subtracts one number from the coordinates along this axis at t
/// = 0, and another number from those at t = 1. Each number is 0, or a vertex's coordinate along the axis at
/// t = 0 or t = 1. An exact subtraction keeps every contact.
Neighbourhood move_axes(const Numbers& /*x*/) {
  Neighbourhood changes;
  for (std::size_t k = 0; k < 3; ++k) {
    changes.push_back({[=](Numbers& x) { replace(x, axis_set(k), [](double) { return 0.0; }); }});
    for (std::size_t vertex = 0; vertex < 4; ++vertex)
      for (const int of_start : {0, 1, 2})
        for (const int of_end : {0, 1, 2})
          changes.push_back({[=](Numbers& x) {
            const std::array shifts{0.0, x[path(vertex, k)], x[paths + path(vertex, k)]};
            subtract(x, k, shifts[static_cast<std::size_t>(of_start)],
                     shifts[static_cast<std::size_t>(of_end)]);
          }});
  }
  return changes;
}

/// Subtracts a multiple of the coordinates along one axis from the coordinates along another axis, so that
/// one coordinate becomes 0.
Neighbourhood shear_axes(const Numbers& /*x*/) {
  Neighbourhood changes;
  for (std::size_t k = 0; k < 3; ++k)
    for (const std::size_t other : {(k + 1) % 3, (k + 2) % 3})
      for (std::size_t point = 0; point < 8; ++point)
        changes.push_back({[=](Numbers& x) {
          if (x[3 * point + other] == 0) return;
          const double factor = x[3 * point + k] / x[3 * point + other];
          for (std::size_t p = 0; p < 8; ++p) x[3 * p + k] -= factor * x[3 * p + other];
        }});
  return changes;
}

/// Copies one position over another, or the motion of one vertex over the motion of another vertex. A
/// position is the place of a vertex at t = 0 or t = 1.
Neighbourhood join_vertices(const Numbers& /*x*/) {
  Neighbourhood changes;
  for (std::size_t to = 0; to < 8; ++to)
    for (std::size_t from = 0; from < 8; ++from)
      changes.push_back({[=](Numbers& x) { std::copy_n(x.begin() + 3 * from, 3, x.begin() + 3 * to); }});
  for (std::size_t to = 0; to < 4; ++to)
    for (std::size_t from = 0; from < 4; ++from)
      changes.push_back({[=](Numbers& x) {
        for (const std::size_t time : times)
          std::copy_n(x.begin() + time + path(from, 0), 3, x.begin() + time + path(to, 0));
      }});
  return changes;
}

/// Moves a vertex by the vector from one vertex to another, or by half or twice that vector. If the vertex
/// and the vector are in the plane of the triangle, or in a plane that contains both edges, the vertex stays
/// in this plane.
Neighbourhood combine_vertices(const Numbers& /*x*/) {
  Neighbourhood changes;
  for (std::size_t vertex = 0; vertex < 4; ++vertex)
    for (std::size_t from = 0; from < 4; ++from)
      for (std::size_t to = 0; to < 4; ++to)
        for (const double factor : {1.0, 0.5, 2.0})
          changes.push_back({[=](Numbers& x) {
            const Numbers before = x;
            for (std::size_t k = 0; k < 3; ++k)
              for (const std::size_t time : times)
                x[time + path(vertex, k)] +=
                    factor * (before[time + path(to, k)] - before[time + path(from, k)]);
          }});
  return changes;
}

/// Makes the motion start or end earlier or later.
Neighbourhood change_times(const Numbers& /*x*/) {
  Neighbourhood changes;
  for (const double t : {-1.0, 0.25, 0.5, 0.75, 2.0})
    for (const std::size_t end : times)
      changes.push_back({[=](Numbers& x) {
        const Numbers before = x;
        for (std::size_t i = 0; i < paths; ++i) x[end + i] = before[i] + t * (before[paths + i] - before[i]);
      }});
  return changes;
}

/// Divides some numbers of the query: all numbers, the coordinates along an axis, the coordinates of a
/// vertex, or the coordinates of a vertex along an axis. The divisor is -1, 3, 5, the magnitude of one of the
/// divided numbers, or a power of two between 1 and such a magnitude.
Neighbourhood scale(const Numbers& numbers) {
  std::vector<Set> sets{everything};
  for (std::size_t k = 0; k < 3; ++k) sets.push_back(axis_set(k));
  for (std::size_t v = 0; v < 4; ++v) sets.push_back(vertex_set(v));
  for (std::size_t i = 0; i < paths; ++i) sets.push_back(path_set(i));
  Neighbourhood changes;
  for (const Set set : sets) {
    std::vector<double> divisors{-1, 3, 5};
    for (const double m : magnitudes_in(set, numbers)) {
      divisors.push_back(m);
      for (int e = std::ilogb(m); e != 0; e /= 2) divisors.push_back(std::ldexp(1.0, e));
    }
    for (const double by : divisors)
      changes.push_back({[=](Numbers& x) { replace(x, set, [&](double c) { return c / by; }); }});
  }
  return changes;
}

/// The numbers that have the same magnitude as number i.
Set alike(const Numbers& x, std::size_t i) {
  Set set = 0;
  for (std::size_t j = 0; j < x.size(); ++j)
    if (std::abs(x[j]) == std::abs(x[i])) set |= only(j);
  return set;
}

/// The replacements that are tried for the numbers of one magnitude. These are 0; small numbers; the other
/// numbers of the query; a number y so small that 1 + y is rounded to 1, and one so large that 1 + y is
/// rounded to y; and numbers with fewer bits.
Alternatives replacements(const Numbers& numbers, Set set) {
  const double magnitude = std::abs(numbers[static_cast<std::size_t>(std::countr_zero(set))]);
  if (magnitude == 0) return {};
  std::vector<double> others{0};
  const auto add = [&](double other) { others.insert(others.end(), {other, -other}); };
  for (const double other : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 0.5, 0.25, 0.75, 1.5, 10.0})
    add(other);
  for (const double other : magnitudes(numbers)) add(other);
  for (const double other : {0x1p-53, 0x1p53}) add(other);
  const int bits = significant_bits(magnitude);
  for (const int fewer : {1, 2, 3, 4, 6, 8, 11, 15, 20, 26, 34, 44, bits - 1}) {
    if (fewer < 1 || fewer >= bits) continue;
    const double unit = std::ldexp(1.0, std::ilogb(magnitude) - fewer + 1);
    const double down = std::floor(magnitude / unit) * unit;
    others.insert(others.end(), {down, down + unit});
  }
  Alternatives changes;
  for (const double other : others)
    changes.emplace_back(
        [=](Numbers& x) { replace(x, set, [&](double c) { return c < 0 ? -other : other; }); });
  return changes;
}

/// Simplifies numbers that have the same magnitude: all numbers of this magnitude in the query, or only those
/// along one axis, those of one vertex along one axis, or a single number.
Neighbourhood change_numbers(const Numbers& x) {
  Neighbourhood changes;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const bool is_coordinate = i != separation;
    const Set of_axis = is_coordinate ? axis_set(i % 3) : only(i);
    const Set of_path = is_coordinate ? path_set(i % paths) : only(i);
    Set last = 0;
    for (const Set within : {everything, of_axis, of_path, only(i)}) {
      const Set set = alike(x, i) & within;
      if (set != last && set % only(i) == 0)  // take each set of numbers only once, at its first member
        changes.push_back(replacements(x, set));
      last = set;
    }
  }
  return changes;
}

/// Sets a path (a vertex's two coordinates along an axis) to 0, or copies another path or its negative.
Neighbourhood copy_paths(const Numbers& /*x*/) {
  Neighbourhood changes;
  for (std::size_t to = 0; to < paths; ++to)
    for (std::size_t from = 0; from < paths; ++from)
      for (const double sign : {0.0, 1.0, -1.0})
        changes.push_back({[=](Numbers& x) {
          for (const std::size_t time : times) x[time + to] = sign * x[time + from];
        }});
  return changes;
}

/// Exchanges two axes, two vertices of a primitive, two edges, or start and end.
Neighbourhood reorder(Kind kind) {
  Neighbourhood changes;
  for (std::size_t k = 0; k < 3; ++k)
    changes.push_back({[=](Numbers& x) {
      for (std::size_t p = 0; p < 8; ++p) std::swap(x[3 * p + k], x[3 * p + (k + 1) % 3]);
    }});
  const auto first = static_cast<std::size_t>(split(kind));
  for (std::size_t v = 0; v < 4; ++v)
    for (std::size_t w = v + 1; w < 4; ++w)
      if ((v < first) == (w < first)) changes.push_back({[=](Numbers& x) { exchange(x, v, w); }});
  if (!has_triangle(kind))
    changes.push_back({[](Numbers& x) {
      exchange(x, 0, 2);
      exchange(x, 1, 3);
    }});
  changes.push_back({[](Numbers& x) { std::swap_ranges(x.begin(), x.begin() + paths, x.begin() + paths); }});
  return changes;
}

}  // namespace

std::vector<std::function<Neighbourhood(const Numbers&)>> neighbourhoods(Kind kind) {
  return {round_all,     change_numbers,
          move_axes,     shear_axes,
          join_vertices, combine_vertices,
          change_times,  scale,
          copy_paths,    [kind](const Numbers&) { return reorder(kind); }};
}

}  // namespace nearmiss
