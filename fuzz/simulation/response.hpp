// How cloth and hair react to contacts (Bridson, Fedkiw, Anderson 2002, "Robust treatment of collisions,
// contact and friction for cloth animation").
#pragma once

#include <vector>

#include "fuzz/scenes/candidates.hpp"
#include "fuzz/simulation/material.hpp"

namespace nearmiss {

/// Changes the positions at the end of a step, so that primitives near each other do not come nearer. The
/// motion of a point in the step is its velocity times the length of the step. Held points, which follow the
/// frames of the scene, are not changed: their mass is infinite.
class Response {
 public:
  Response(std::vector<bool> held, const Material& material) : held_(std::move(held)), material_(material) {}

  /// Repels a pair that is nearer than the thickness at the start of the step (§7.2 of the paper). Stops the
  /// approach of the pair by an inelastic impulse, and moves the primitives apart by a tenth of (thickness -
  /// distance). Does not move primitives that touch, since there is no direction in which to move them apart.
  void repel(const Candidate& pair, const PointVectors& start, PointVectors& end) const;

  /// Stops the approach of a pair that collides at a time in [0, 1]. To do so, applies an inelastic impulse
  /// along the normal, and friction (§7.4 of the paper). If the time is NaN, uses the end of the step.
  void stop_approach(const Candidate& pair, double time, const PointVectors& start, PointVectors& end) const;

  /// Moves the points of a zone (connected pairs that still collide) rigidly, with their common linear and
  /// angular momentum (§7.5 of the paper). If some of the points are held, all other points move by the mean
  /// motion of the held points.
  void move_rigidly(const std::vector<int>& zone, const PointVectors& start, PointVectors& end) const;

 private:
  struct Touch;
  [[nodiscard]] Touch touch(const Candidate& pair, double time, const PointVectors& start,
                            const PointVectors& end) const;
  void apply(const Candidate& pair, const Touch& touch, double least_normal_motion, PointVectors& end) const;

  std::vector<bool> held_;
  Material material_;
};

}  // namespace nearmiss
