#include "fuzz/search/maximiser.hpp"

#include <algorithm>
#include <array>
#include <nlopt.hpp>
#include <stdexcept>

#include "fuzz/search/search.hpp"

namespace nearmiss {

SearchPoint Maximiser::run(const Draw& draw_start) {
  constexpr int starts = 50;
  for (int i = 0; i < starts && !over(); ++i) show(draw_start());
  for (bool again = false; !over(); again = true) optimise(again);
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
  constexpr int evaluations = 300;
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
  } catch (const nlopt::roundoff_limited&) {  // steps became too small to change the value
  } catch (const std::runtime_error&) {       // the model of BOBYQA broke down
  }
  if (error_) std::rethrow_exception(error_);
}

double Maximiser::value_at(const std::vector<double>& x) {
  double value = unwanted;
  try {
    value = show(point_at(x));
  } catch (...) {
    error_ = std::current_exception();  // the optimiser would take it for an exception of its own
  }
  if (over()) optimiser_->force_stop();
  return std::min(value, 1e3);  // finite, because optimisers compute with it
}

SearchPoint Maximiser::point_at(const std::vector<double>& x) const {
  SearchPoint point;
  point.gap.setZero();
  const double* from = x.data();
  point.visit(touching_, [&](Vector3<double>& v) {
    v = Vector3<double>(from[0], from[1], from[2]);
    from += 3;
  });
  return point;
}

}  // namespace nearmiss
