#include "fuzz/search/maximiser.hpp"

#include <algorithm>
#include <array>
#include <bitset>
#include <nlopt.hpp>
#include <stdexcept>

#include "fuzz/search/search.hpp"

namespace nearmiss {

namespace {

constexpr int evaluations = 300;  ///< of one optimisation

}  // namespace

SearchPoint Maximiser::run(const Draw& draw_start) {
  constexpr int starts = 50;
  for (int i = 0; i < starts && !over(); ++i) show(draw_start());
  for (bool again = false; !over(); again = true) {
    if (moves_vertices_ && random_.one_in(2))
      move_vertices();
    else
      optimise(again);
  }
  return best_;
}

bool Maximiser::over() const {
  return shown_ >= search_evaluations || best_value_ == HUGE_VAL || error_ != nullptr;
}

double Maximiser::show(const SearchPoint& point) {
  ++shown_;
  const double value = objective_(point);
  if (value > best_value_) {
    best_value_ = value;
    best_ = point;
  }
  return value;
}

void Maximiser::optimise(bool beside) {
  constexpr std::array algorithms{nlopt::LN_SBPLX, nlopt::LN_NELDERMEAD, nlopt::LN_BOBYQA};
  const double step = search_log_uniform(random_, finest_step_, 0.5);
  SearchPoint start = best_;
  if (beside) start.visit(touching_, [&](Vector3<double>& v) { v += random_.vector(step); });
  std::vector<double> point;
  start.visit(touching_, [&](const Vector3<double>& v) { point.insert(point.end(), v.begin(), v.end()); });

  nlopt::opt optimiser(algorithms[static_cast<std::size_t>(random_.integer(0, 2))],
                       static_cast<unsigned>(point.size()));
  optimiser.set_max_objective([](const std::vector<double>& x, std::vector<double>& /*gradient*/,
                                 void* self) { return static_cast<Maximiser*>(self)->value_at(x); },
                              this);
  optimiser_ = &optimiser;
  optimiser.set_initial_step(step);
  optimiser.set_maxeval(evaluations);
  optimiser.set_xtol_rel(1e-9);
  double value = 0;
  try {
    optimiser.optimize(point, value);
  } catch (const nlopt::forced_stop&) {       // the search is over
  } catch (const nlopt::roundoff_limited&) {  // the optimiser's steps became too small to change the value
  } catch (const std::runtime_error&) {       // the model of BOBYQA broke down
  }
  if (error_) std::rethrow_exception(error_);
}

void Maximiser::move_vertices() {
  const int last = shown_ + evaluations;
  double size = search_log_uniform(random_, finest_step_, 0.5);
  while (!over() && shown_ < last) {
    Displacements step = draw_step(size * search_log_uniform(random_, 1.0 / 8, 8));
    bool gained = false;
    for (; !over() && gains(step); gained = true)
      for (double& c : step) c *= 2;
    size *= gained ? 1.5 : 0.97;
  }
}

Displacements Maximiser::draw_step(double size) {
  const Vector3<double> by = random_.vector(size);
  const auto draw = [&](int lo, int hi) { return static_cast<unsigned>(random_.integer(lo, hi)); };
  const std::bitset<3> axes(draw(1, 7));
  const std::bitset<8> points(random_.one_in(2) ? 1U << draw(0, 7) : draw(1, 255));
  Displacements step{};
  for (std::size_t i = 0; i < step.size(); ++i)
    if (points[i / 3] && axes[i % 3]) step[i] = by[static_cast<Eigen::Index>(i % 3)];
  return step;
}

bool Maximiser::gains(const Displacements& step) {
  SearchPoint point = best_;
  for (std::size_t i = 0; i < step.size(); ++i) point.moved[i] += step[i];
  const double before = best_value_;
  return show(point) > before;
}

double Maximiser::value_at(const std::vector<double>& x) {
  double value = unwanted;
  try {
    value = show(point_at(x));
  } catch (...) {
    error_ = std::current_exception();  // the exception must not pass through the code of NLopt
  }
  if (over()) optimiser_->force_stop();
  return std::min(value, 1e3);  // the result is finite, because optimisers compute with it
}

SearchPoint Maximiser::point_at(const std::vector<double>& x) const {
  SearchPoint point = best_;
  const double* from = x.data();
  point.visit(touching_, [&](Vector3<double>& v) {
    v = Vector3<double>(from[0], from[1], from[2]);
    from += 3;
  });
  return point;
}

}  // namespace nearmiss
