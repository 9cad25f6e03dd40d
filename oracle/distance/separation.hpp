// Certified lower bounds of the distance of the two primitives around a time.
#pragma once

#include <algorithm>
#include <array>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <cstddef>

#include "oracle/arithmetic/bernstein.hpp"
#include "oracle/distance/closest.hpp"

// The primitives are the convex hulls of their vertices. So for any vector n(t), their distance is at least
// the smallest of the numbers n(t) · (x_i - x_j)(t) / |n(t)|, where i is a vertex of the first primitive and
// j a vertex of the second. At a time t0, this bound is sharp if n(t0) has the direction between the closest
// points. Around t0, the products n · (x_i - x_j) are polynomials in s = t - t0 for three kinds of n:
//
// - A constant n gives linear products.
// - n = edge(t) × k with a constant k gives quadratic products. The products are the same for both vertices
//   of this edge, so the bound does not weaken as the edge turns.
// - n = N(t), the normal of the triangle or of both edges: all products are ±F, the coplanarity cubic.
//
// Errors of the coefficients. Each coefficient is a sum of products of components of two or three vectors.
// Each product is rounded at most m times on its way into the coefficient, so its relative error is at most m
// U (U = roundoff<Real>, the relative error of one operation). For three vectors of lengths a, b, c the
// magnitudes of the products add up to at most 2/√3 a b c (Carlen, Lieb and Loss 2006, about permanents); for
// two vectors, to at most a b. For a cross product, the magnitudes are added up in each component, and these
// three sums form a vector of length at most 2/√3 a b. A vector x = x_i - x_j has a length of at most R =
// reach(i, j), and its velocity w has a length of at most 2 R. The table has one number for each coefficient,
// beginning with the coefficient of s^0. The unit of the lengths is the product of the R of all factors and
// of |n| or |k|; the unit of the errors is U times as large. An error is m times the length and, except in
// the first row, times 2/√3:
//
//               m                lengths        error                       taken
//   n·x, n·w    7, 5             1, 2           7, 10                       8, 16
//   (e × k)·x   13, 12, 9        1, 4, 4        15.1, 55.5, 41.6            16, 64, 64
//   e × k       6, 4             1, 2           7, 9.3                      16, 32
//   F           17, 17, 15, 11   1, 6, 12, 8    19.7, 117.8, 207.9, 101.7   24, 144, 288, 192
//   N           10, 9, 6         1, 4, 4        11.6, 41.6, 27.8            16, 64, 64
//
// tests/oracle/separation_test.cpp determines m with a scalar that counts roundings in the templates below.
//
// The column "taken" exceeds the error to cover terms of second order in U and the rounding of the bounds
// themselves. Rounding a coefficient to double adds 2^-53 of its magnitude to the error; the code adds 2^-52.
// In each of fewer than 100 operations, underflow adds at most 2^-1018 times the length of k to a
// coefficient; the length of k is at most 2^100. Underflow adds at most 2^-536 to the length of n. All this
// is far below `least_distance`, which is added to each error.

namespace nearmiss::certified {

/// Distances below this number, in the unit of VertexDifferences, cannot be distinguished from 0.
inline constexpr double least_distance = 0x1p-500;

/// A polynomial in s of degree 3, and a bound of the error of each of its coefficients.
struct Product {
  std::array<double, 4> coefficients{};
  std::array<double, 4> errors{};
};

/// A lower bound of the distance that one direction n(s) gives. At every s, the distance is at least the
/// smallest of the products divided by |n|. The length |n| is at most length[0] + length[1] |s| + length[2]
/// s².
struct Separation {
  boost::container::static_vector<Product, 4> products;
  std::array<double, 3> length{};

  void add(const std::array<double, 4>& coefficients, const std::array<double, 4>& errors) {
    Product& product = products.emplace_back(Product{coefficients, errors});
    for (std::size_t i = 0; i < 4; ++i)
      product.errors[i] += 0x1p-52 * std::abs(coefficients[i]) + least_distance;
  }
};

/// An upper bound of the exact length of a vector. v has the computed components of the vector, rounded to
/// double, and `error` bounds the error of the vector before this rounding.
inline double longest(const Vec<double>& v, double error) {
  return length(v) * (1 + 0x1p-48) + error + least_distance;
}

/// The lower bound with n = `direction`, which points from the second primitive to the first.
template <class Real>
Separation separate_by_constant(const VerticesAt<Real>& x, const Vec<double>& direction) {
  const VertexDifferences& differences = x.differences();
  Separation separation;
  separation.length = {longest(direction, 0), 0, 0};
  const Vec<Real> n = of_double<Real>(direction);
  for (const auto& [i, j] : topology(differences.kind()).gaps) {
    const double error = 8 * roundoff<Real> * separation.length[0] * differences.reach(i, j);
    separation.add({to_double(dot(n, x.position(i, j))), to_double(dot(n, x.velocity(i, j))), 0, 0},
                   {error, 2 * error, 0, 0});
  }
  return separation;
}

/// The lower bound with n = (x_to - x_from) × k. The constant k is chosen such that n is as near to
/// `direction` as possible.
template <class Real>
Separation separate_by_edge(const VerticesAt<Real>& x, std::size_t from, std::size_t to,
                            const Vec<double>& direction) {
  const VertexDifferences& differences = x.differences();
  const Vec<Real> edge = x.position(to, from);
  const Vec<double> rough_edge = to_double(edge);
  const double squared_length = dot(rough_edge, rough_edge);
  // If the squared length of the edge is below this number, k is so large that underflow matters.
  constexpr double too_short = 0x1p-200;
  if (!(squared_length > too_short)) return {};
  const Vec<double> key =
      (1 / squared_length) * cross(direction, rough_edge);  // e × (d × e) = |e|² d for d at right angles to e
  const Vec<Real> k = of_double<Real>(key);
  const Vec<Real> n0 = cross(edge, k);
  const Vec<Real> n1 = cross(x.velocity(to, from), k);
  const double unit = roundoff<Real> * differences.reach(to, from) * length(key);

  Separation separation;
  separation.length = {longest(to_double(n0), 16 * unit), longest(to_double(n1), 32 * unit), 0};
  const auto add = [&](std::size_t i, std::size_t j) {
    const Vec<Real> p = x.position(i, j);
    const Vec<Real> w = x.velocity(i, j);
    const double error = 16 * unit * differences.reach(i, j);
    separation.add({to_double(dot(n0, p)), to_double(dot(n0, w) + dot(n1, p)), to_double(dot(n1, w)), 0},
                   {error, 4 * error, 4 * error, 0});
  };
  // The products n · (x_i - x_j) are the same for the vertex `to` as for the vertex `from`.
  for (const auto& [i, j] : topology(differences.kind()).gaps)
    if (i != to && j != to) add(i, j);
  return separation;
}

/// The lower bound with the normal, n = N(t).
template <class Real>
Separation separate_by_normal(const VerticesAt<Real>& x) {
  const VertexDifferences& differences = x.differences();
  const NormalPairs pairs = normal_pairs(differences.kind());
  const Vec<Real> q = x.position(pairs.q);
  const Vec<Real> r = x.position(pairs.r);
  const Vec<Real> p = x.position(pairs.p);
  const Vec<Real> v = x.velocity(pairs.q);
  const Vec<Real> w = x.velocity(pairs.r);
  const Vec<Real> u = x.velocity(pairs.p);
  const Vec<Real> N0 = cross(q, r);
  const Vec<Real> N1 = cross(v, r) + cross(q, w);
  const Vec<Real> N2 = cross(v, w);
  const double area = roundoff<Real> * differences.reach(pairs.q) * differences.reach(pairs.r);

  Separation separation;
  separation.length = {longest(to_double(N0), 16 * area), longest(to_double(N1), 64 * area),
                       longest(to_double(N2), 64 * area)};
  std::array<double, 4> F{to_double(dot(N0, p)), to_double(dot(N1, p) + dot(N0, u)),
                          to_double(dot(N2, p) + dot(N1, u)), to_double(dot(N2, u))};
  if (F[0] < 0)
    for (double& c : F) c = -c;
  const double volume = area * differences.reach(pairs.p);
  separation.add(F, {24 * volume, 144 * volume, 288 * volume, 192 * volume});
  return separation;
}

/// The length of an interval of times from t0, forward (1) or backward (-1), in which the distance is
/// certainly at least `distance`. The result is at most `most`.
double certified_reach(const Separation& separation, double distance, int direction, double most);

}  // namespace nearmiss::certified
