// How cloth and hair react to contacts (Bridson, Fedkiw, Anderson 2002, "Robust treatment of collisions,
// contact and friction for cloth animation").
#pragma once

#include <vector>

#include "fuzz/scenes/candidates.hpp"
#include "fuzz/simulation/material.hpp"

namespace nearmiss {

/// Changes the positions at the end of a step, so that primitives near each other do not come nearer. The
/// motion of a point in the step is its velocity times the step. A held point is never moved: it has infinite
/// mass.
class Response {
 public:
  Response(std::vector<bool> held, const Material& material) : held_(std::move(held)), material_(material) {}

  /// Pushes a pair apart that is nearer than the thickness at the start of the step: an inelastic impulse if
  /// they approach, and a tenth of the missing distance (§7.2 there). Primitives that touch have no side to which
  /// they could be pushed, and are left as they are.
  void repel(const Candidate& pair, const PointVectors& start, PointVectors& end) const;

  /// Ends the approach of a pair that collides at a time in [0, 1]: an inelastic impulse along the normal, and
  /// friction (§7.4 there). If the time is NaN, the end of the step stands for it.
  void stop_approach(const Candidate& pair, double time, const PointVectors& start, PointVectors& end) const;

  /// Moves the points of a zone rigidly, with their common linear and angular momentum (§7.5 there); a zone
  /// with held points moves as these do on average.
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
