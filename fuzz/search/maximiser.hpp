// Derivative-free optimisation among the points of directed search.
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

/// The value of the objective for an unwanted query, far below all others.
inline constexpr double unwanted = -1e3;

/// Maximises an objective from random starting points.
class Maximiser {
 public:
  using Objective = std::function<double(const SearchPoint&)>;  ///< infinity ends the search
  using Draw = std::function<SearchPoint()>;

  /// Step sizes are drawn between `finest_step` and 0.5.
  Maximiser(Random& random, bool touching, double finest_step, Objective objective)
      : random_(random), touching_(touching), finest_step_(finest_step), objective_(std::move(objective)) {}

  /// The best of search_evaluations points. Throws what the objective throws.
  SearchPoint run(const Draw& draw_start);

 private:
  [[nodiscard]] bool over() const;
  double show(const SearchPoint& point);
  /// Optimises from the best point so far, or from one near it (`beside`), with steps of a random size.
  void optimise(bool beside);
  /// The objective as an optimiser sees it.
  double value_at(const std::vector<double>& x);
  [[nodiscard]] SearchPoint point_at(const std::vector<double>& x) const;

  Random& random_;
  bool touching_;
  double finest_step_;
  Objective objective_;
  nlopt::opt* optimiser_ = nullptr;
  int shown_ = 0;
  double best_value_ = -HUGE_VAL;
  SearchPoint best_;
  std::exception_ptr error_;  ///< thrown by the objective
};

}  // namespace nearmiss
