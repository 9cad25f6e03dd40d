// A plug-in that filters steps in the way in which some solvers do: it stops vertices at planes between the
// two primitives. The option defect=N adds typical mistake number N; defect=0 adds none.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ccd/nearmiss_functions.hpp"

namespace {

using nearmiss::plugin::Question;
using nearmiss::plugin::vertices_of;

struct Settings {
  double defect = 0;
};

constexpr std::array<nearmiss::Option<Settings>, 1> settings{{{"defect", &Settings::defect, 0, 100}}};

/// Filters the step of one query. The filter takes the largest of the gaps between the primitives' boxes at
/// t = 0 along the three axes. Each primitive may move into this gap up to a plane, which is 40 % of the gap
/// away from the primitive's box. If the boxes overlap, nothing moves.
class Filter {
 public:
  Filter(const Settings& given, const Question& q)
      : defect_(static_cast<int>(given.defect)),
        q_(q),
        n_(vertices_of(q.kind)),
        first_(q.kind == NEARMISS_EDGE_EDGE ? 2 : 1) {}

  double run(double* y) const {
    const std::size_t size = 3 * n_;
    std::copy_n(q_.x, size, y);
    const auto [axis, below, above, is_first_below] = widest();
    const double gap = above - below;
    if (!(gap > 0)) return is(1) ? let_all_move(y) : 0;  // overlapping boxes
    const double rounding = 1e-14 * (std::abs(above) + std::abs(below));
    if (!(gap > 1e3 * rounding)) return 0;
    // With defect 2, the planes are in the wrong order; with defect 3, they are identical.
    const double part = is(2) ? 0.6 : is(3) ? 0.5 : 0.4;
    // With defect 4, one primitive gets the plane of the other primitive.
    const double low = is(4) ? above - part * gap : below + part * gap;
    const double high = above - part * gap;
    for (std::size_t i = 0; i < n_; ++i) {
      const bool is_low = (i < first_) == is_first_below;
      const double x = q_.x[3 * i + axis];
      const double motion = q_.x[size + 3 * i + axis] - x;
      double room = is_low ? low - x : x - high;
      if (is(10)) {  // gives all vertices of a primitive the room of its first vertex
        const double first = q_.x[i < first_ ? axis : 3 * first_ + axis];
        room = is_low ? low - first : first - high;
      }
      const double towards = is_low ? motion : -motion;
      double t = towards > room ? room / towards : 1;
      if (is(5) && !is_low) t = 1;             // does not filter the vertices of one primitive
      if (is(6)) t = std::min(1.0, 1.25 * t);  // moves vertices by 1.25 times the allowed motion
      if (is(7) && i + 1 == n_) t = 1;         // does not filter the last vertex
      if (is(8)) t = static_cast<double>(static_cast<float>(t) * 1.5F);
      // Defect 9 also stops vertices that move away from the other primitive. Still, the step is safe.
      if (is(9) && towards < 0) t = 0;
      // Defect 11 treats slow vertices as if they were at rest, and does not filter them.
      if (is(11) && std::abs(motion) < 1e-3) t = 1;
      // Defect 12 does not stop vertices that have little room before their plane.
      if (is(12) && room < 1e-3) t = 1;
      for (std::size_t k = 0; k < 3; ++k) {
        const double from = q_.x[3 * i + k];
        y[3 * i + k] = t == 1 ? q_.x[size + 3 * i + k] : from + t * (q_.x[size + 3 * i + k] - from);
      }
    }
    const double kept = (1 - 2 * part) * gap - 4 * rounding;
    if (is(13)) return gap;         // claims the clearance that the primitives have at the start of the step
    if (is(14)) return 1.5 * kept;  // claims too much
    if (is(15)) return std::abs(kept) + 1e-3;
    if (is(16)) return -kept;  // a negative clearance
    return is(2) || is(3) || is(4) ? 0 : std::max(kept, 0.0);
  }

 private:
  struct Gap {
    std::size_t axis;
    double below, above;
    bool is_first_below;
  };

  Gap widest() const {
    Gap best{0, 0, 0, true};
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<double, 2> lo{HUGE_VAL, HUGE_VAL}, hi{-HUGE_VAL, -HUGE_VAL};
      for (std::size_t i = 0; i < n_; ++i) {
        const std::size_t side = i < first_ ? 0 : 1;
        lo[side] = std::min(lo[side], q_.x[3 * i + k]);
        hi[side] = std::max(hi[side], q_.x[3 * i + k]);
      }
      for (const bool is_first_below : {true, false}) {
        const double below = hi[is_first_below ? 0 : 1], above = lo[is_first_below ? 1 : 0];
        if (above - below > best.above - best.below) best = {k, below, above, is_first_below};
      }
    }
    return best;
  }

  double let_all_move(double* y) const {
    std::copy_n(q_.x + 3 * n_, 3 * n_, y);
    return 0;
  }

  bool is(int defect) const { return defect_ == defect; }

  int defect_;
  const Question& q_;
  std::size_t n_, first_;
};

double filter(const Settings& set, const Question& q, double* y) { return Filter(set, q).run(y); }

}  // namespace

NEARMISS_SUBJECT(detector("steps")
                     .options<settings>()
                     .vertex_triangle_step(filter)
                     .edge_edge_step(filter)
                     .vertex_vertex_step(filter)
                     .vertex_edge_step(filter))
