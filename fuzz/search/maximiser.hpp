// Derivative-free optimisation in the search space of directed search (search_point.hpp).
#pragma once

#include <cmath>
#include <exception>
#include <functional>
#include <vector>

#include "fuzz/random.hpp"
#include "fuzz/search/search_point.hpp"

namespace nlopt {
class opt;
}

namespace nearmiss {

/// The value of the objective for an unwanted query, far below the values of all other queries.
inline constexpr double unwanted = -1e3;

/// Maximises an objective from random starting points.
class Maximiser {
 public:
  using Objective = std::function<double(const SearchPoint&)>;  ///< infinity ends the search
  using Draw = std::function<SearchPoint()>;

  /// If `touching` is true, the optimisations do not change the gap between the primitives. Step sizes are
  /// drawn between `finest_step` and 0.5. If `moves_vertices` is true, about half of the optimisations move
  /// vertices instead of the vectors that SearchPoint::visit() visits; after such moves, the primitives may
  /// not touch any more.
  Maximiser(Random& random, bool touching, double finest_step, Objective objective,
            bool moves_vertices = false)
      : random_(random),
        touching_(touching),
        moves_vertices_(moves_vertices),
        finest_step_(finest_step),
        objective_(std::move(objective)) {}

  /// Tries at most search_evaluations points, and returns the point with the largest value of the objective.
  /// If the objective throws an exception, throws it, too.
  SearchPoint run(const Draw& draw_start);

 private:
  [[nodiscard]] bool over() const;
  double show(const SearchPoint& point);
  /// Starts an optimisation at the best point so far or, if `beside` is true, at a point near it. The size of
  /// the first step is random.
  void optimise(bool beside);
  /// Moves vertices of the best point so far. If a step improves the point, it is repeated, each time twice
  /// as long, until it does not improve the point. The size of steps grows after an improvement, and shrinks
  /// after a step that does not improve the point.
  void move_vertices();
  /// Draws a step: one displacement along some axes, for one or several of the eight positions (four
  /// vertices, at t = 0 and t = 1).
  Displacements draw_step(double size);
  /// Tries the point that the step reaches from the best point so far. If this point is better, it becomes
  /// the best point. Returns whether it is better.
  bool gains(const Displacements& step);
  /// The objective in the form that NLopt expects.
  double value_at(const std::vector<double>& x);
  [[nodiscard]] SearchPoint point_at(const std::vector<double>& x) const;

  Random& random_;
  bool touching_;
  bool moves_vertices_;
  double finest_step_;
  Objective objective_;
  nlopt::opt* optimiser_ = nullptr;
  int shown_ = 0;
  double best_value_ = -HUGE_VAL;
  SearchPoint best_;
  std::exception_ptr error_;  ///< thrown by the objective
};

}  // namespace nearmiss
