#include "fuzz/simulation/response.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

#include "fuzz/scenes/built_in/formulas.hpp"
#include "fuzz/simulation/closest.hpp"

namespace nearmiss {

namespace {

std::size_t index(int point) { return static_cast<std::size_t>(point); }

}  // namespace

/// The contact of a pair: the place of the contact, its normal, and the relative motion of the primitives
/// there.
struct Response::Touch {
  std::array<double, 4> weights{};  ///< as in closest_weights
  /// A vector of length 1 from the second primitive to the first; 0 if unknown.
  Vector3<double> normal{0, 0, 0};
  /// The distance of the primitives along the normal, at the start of the step.
  double distance = 0;
  Vector3<double> motion{0, 0, 0};  ///< the motion of the first primitive relative to the second, in the step
};

Response::Touch Response::touch(const Candidate& pair, double time, const PointVectors& start,
                                const PointVectors& end) const {
  const double t = std::isnan(time) ? 1 : time;
  std::array<Vector3<double>, 4> x;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t point = index(pair.vertices[i]);
    x[i] = (1 - t) * start[point] + t * end[point];
  }
  Touch touch{.weights = closest_weights(pair.kind, x)};
  Vector3<double> from(0, 0, 0);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t point = index(pair.vertices[i]);
    from += touch.weights[i] * start[point];
    touch.motion += touch.weights[i] * (end[point] - start[point]);
  }
  const auto& edges = topology(pair.kind).pqr;  // q and r, whose cross product is the normal
  const Vector3<double> u = x[edges[1].to] - x[edges[1].from];
  const Vector3<double> v = x[edges[2].to] - x[edges[2].from];
  // If the primitives collide after t = 0, and q and r (two edges of the pair) are not nearly parallel, the
  // normal is q × r. Otherwise, the normal is the vector between the closest points.
  const Vector3<double> cross = u.cross(v);
  constexpr double parallel = 1e-6;
  touch.normal = time > 0 && length(cross) > parallel * length(u) * length(v) ? cross : from;
  const double size = length(touch.normal);
  if (size > 0) touch.normal /= size;
  touch.distance = dot(from, touch.normal);
  if (touch.distance < 0) {
    touch.distance = -touch.distance;
    touch.normal = -touch.normal;
  }
  return touch;
}

/// Applies an impulse, and the friction that the impulse causes. After the impulse, the primitives move apart
/// along the normal by at least `least_normal_motion` in the step.
void Response::apply(const Candidate& pair, const Touch& touch, double least_normal_motion,
                     PointVectors& end) const {
  const double along = dot(touch.motion, touch.normal);
  const double change = least_normal_motion - along;
  if (!(change > 0)) return;
  const Vector3<double> sliding = touch.motion - along * touch.normal;
  const double slides = length(sliding);
  const double braked = slides > 0 ? std::min(1.0, material_.friction * change / slides) : 0;
  const Vector3<double> impulse = change * touch.normal - braked * sliding;
  double compliance = 0;
  for (std::size_t i = 0; i < 4; ++i)
    if (!held_[index(pair.vertices[i])]) compliance += touch.weights[i] * touch.weights[i];
  if (!(compliance > 0)) return;
  for (std::size_t i = 0; i < 4; ++i)
    if (!held_[index(pair.vertices[i])])
      end[index(pair.vertices[i])] += (touch.weights[i] / compliance) * impulse;
}

void Response::repel(const Candidate& pair, const PointVectors& start, PointVectors& end) const {
  constexpr double part = 0.1;
  const Touch near = touch(pair, 0, start, end);
  const double missing = material_.thickness * material_.edge - near.distance;
  const double least = part * missing;
  if (near.distance > 0 && missing > 0) apply(pair, near, least, end);
}

void Response::stop_approach(const Candidate& pair, double time, const PointVectors& start,
                             PointVectors& end) const {
  apply(pair, touch(pair, time, start, end), 0, end);
}

void Response::move_rigidly(const std::vector<int>& zone, const PointVectors& start,
                            PointVectors& end) const {
  const bool any_held = std::any_of(zone.begin(), zone.end(), [&](int point) { return held_[index(point)]; });
  const auto leads = [&](int point) { return !any_held || held_[index(point)]; };
  Vector3<double> centre(0, 0, 0), motion(0, 0, 0);
  int leading = 0;
  for (const int point : zone)
    if (leads(point)) {
      centre += start[index(point)];
      motion += end[index(point)] - start[index(point)];
      ++leading;
    }
  centre /= leading;
  motion /= leading;
  Rotation rotation;
  if (!any_held) {
    Vector3<double> momentum(0, 0, 0);
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
    for (const int point : zone) {
      const Vector3<double> r = start[index(point)] - centre;
      momentum += r.cross(end[index(point)] - start[index(point)] - motion);
      inertia += dot(r, r) * Eigen::Matrix3d::Identity() - r * r.transpose();
    }
    // If all points are on a line, they have no inertia about this line, and the matrix is singular. Adding a
    // small multiple of the identity makes the matrix invertible.
    constexpr double relative = 1e-9;
    inertia += relative * inertia.trace() * Eigen::Matrix3d::Identity();
    const Vector3<double> turn =
        inertia.trace() > 0 ? Vector3<double>(inertia.ldlt().solve(momentum)) : Vector3<double>(0, 0, 0);
    constexpr double radians = 6.283185307179586;
    if (const double angle = length(turn); angle > 0) rotation = Rotation(turn / angle, angle / radians);
  }
  for (const int point : zone)
    if (!held_[index(point)]) end[index(point)] = centre + motion + rotation(start[index(point)] - centre);
}

}  // namespace nearmiss
