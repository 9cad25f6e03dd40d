// The two primitives at one time of the step: their distance, and lower bounds of the distance around that
// time.
#pragma once

#include <algorithm>
#include <array>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <cstddef>

#include "oracle/arithmetic/guess.hpp"
#include "oracle/distance/separation.hpp"

namespace nearmiss::certified {

/// Facts and estimates about the two primitives at one time of the step. All lengths are in the unit of
/// VertexDifferences.
struct Moment {
  bool is_precise = false;   ///< whether the moment was computed in the Real of DistanceSearch, not in double
  ClosestFeatures features;  ///< the parts of the primitives that contain the closest points, uncertified
  double upper = 0;          ///< a certified upper bound of the distance
  double slope = 0;          ///< a number with the sign of the derivative of the distance, uncertified
  double step = 0;           ///< time from here to the minimum of the distance, estimated
  double predicted = 0;      ///< the distance at that minimum, estimated
  double rate = 0;           ///< derivative of the distance, estimated
  Vec<double> direction{};   ///< unit vector from the second primitive's closest point to the first's, or 0

  /// Lower bounds of the distance: first the bound that fits the features of the closest points best; then,
  /// if `has_all`, the other bounds.
  boost::container::small_vector<Separation, 1> separations;
  bool has_all = false;
};

namespace detail {

inline Vec<double> direction_of(const Vec<double>& v) {
  const double size = length(v);
  return size > 0 ? (1 / size) * v : Vec<double>{};
}

/// Predicts the minimum of |d + s v| over s, for closest points with the difference d and the relative
/// velocity v. The velocity must not have a component along the features.
inline void predict(Moment& moment, const Vec<double>& difference, const Vec<double>& velocity) {
  const double squared_speed = dot(velocity, velocity);
  const double squared_distance = dot(difference, difference);
  moment.slope = dot(difference, velocity);
  moment.step = squared_speed > 0 ? -moment.slope / squared_speed : 0;
  moment.predicted = std::sqrt(std::max(0.0, squared_distance + moment.slope * moment.step));
}

/// Predicts the smallest distance if the closest points lie in the interiors of the primitives. Then the
/// distance is |F| / |N|, where F is the coplanarity cubic and N the normal, and N changes little while F
/// goes to zero or to its extremum. (The difference of the closest points is less useful: if the primitives
/// slide along each other, the component of this difference along the velocity consists of rounding errors
/// only.)
inline void predict(Moment& moment, double distance, const Powers<double>& F) {
  moment.predicted = distance;
  if (!(F.c[0] > 0)) return;
  moment.slope = F.c[1] / F.c[0];
  if (const auto root = root_near_zero(F)) {
    moment.step = *root;
    moment.predicted = 0;
  } else {
    moment.step = extremum_near_zero(F);
    moment.predicted = distance * std::max(0.0, F.at(moment.step) / F.c[0]);
  }
}

}  // namespace detail

/// A bound of the error with which the difference of the closest points is computed. This difference is a sum
/// of at most three vertex differences, each rounded four times and multiplied by an exact weight in
/// [0, 1]. The additions take at most three more roundings. The weights of interiors may add up to
/// 1 + 2 roundoff<Real>.
template <class Real>
double points_error(const VertexDifferences& differences) {
  return 12 * roundoff<Real> * differences.total_reach();
}

/// An upper bound of the distance of the primitives, given the computed distance of a point of each.
template <class Real>
double upper_bound(const ClosestPoints<Real>& closest, const VertexDifferences& differences) {
  return std::sqrt(closest.squared_distance) * (1 + 0x1p-48) + points_error<Real>(differences) +
         least_distance;
}

/// The lower bound that fits the features of the closest points best; `direction` is the direction between
/// these points.
template <class Real>
Separation separate_by_features(const VerticesAt<Real>& x, const ClosestFeatures& features,
                                const Vec<double>& direction) {
  switch (features.combination) {
    case ClosestFeatures::Combination::vertices:
      return separate_by_constant(x, direction);
    case ClosestFeatures::Combination::vertex_and_edge:
      return separate_by_edge(x, features.from, features.to, direction);
    case ClosestFeatures::Combination::interiors:
      break;
  }
  return separate_by_normal(x);
}

template <class Real>
Moment look(const VerticesAt<Real>& x) {
  const ClosestPoints<Real> closest = closest_points(x);
  const ClosestFeatures& features = closest.features;
  Moment moment;
  moment.features = features;
  moment.upper = upper_bound(closest, x.differences());
  const Vec<double> difference = to_double(closest.difference);
  const Vec<double> velocity = to_double(closest.velocity);
  moment.direction = detail::direction_of(difference);
  moment.rate = dot(moment.direction, velocity);
  moment.separations.push_back(separate_by_features(x, features, moment.direction));
  switch (features.combination) {
    case ClosestFeatures::Combination::vertices:
      detail::predict(moment, difference, velocity);
      break;
    case ClosestFeatures::Combination::vertex_and_edge: {
      const Vec<double> edge = to_double(x.position(features.to, features.from));
      detail::predict(moment, difference, velocity - (dot(velocity, edge) / dot(edge, edge)) * edge);
      break;
    }
    case ClosestFeatures::Combination::interiors:
      detail::predict(moment, std::sqrt(closest.squared_distance),
                      {moment.separations[0].products[0].coefficients});
      break;
  }
  return moment;
}

/// Adds the other lower bounds. They fit the features less well at this time, but may remain useful for
/// longer. If edges are nearly parallel, for example, the normal turns much faster than the direction between
/// the closest points.
template <class Real>
void add_other_separations(Moment& moment, const VerticesAt<Real>& x) {
  moment.has_all = true;
  const ClosestFeatures& features = moment.features;
  Vec<double> direction = moment.direction;
  if (features.combination == ClosestFeatures::Combination::interiors) {
    // The closest points may be so near each other that rounding changes the direction of their difference
    // more than that of the normal.
    const NormalPairs pairs = normal_pairs(x.differences().kind());
    direction = detail::direction_of(to_double(cross(x.position(pairs.q), x.position(pairs.r))));
    if (dot(direction, moment.direction) < 0) direction = -direction;
  } else {
    moment.separations.push_back(separate_by_normal(x));
  }
  if (features.combination != ClosestFeatures::Combination::vertices)
    moment.separations.push_back(separate_by_constant(x, direction));
  const auto add_edge = [&](std::size_t from, std::size_t to) {
    const bool is_there = features.combination == ClosestFeatures::Combination::vertex_and_edge &&
                          features.from + features.to == from + to &&
                          (features.from == from || features.from == to);
    if (!is_there) moment.separations.push_back(separate_by_edge(x, from, to, direction));
  };
  for (const VertexPair edge : topology(x.differences().kind()).edges) add_edge(edge.from, edge.to);
}

}  // namespace nearmiss::certified
