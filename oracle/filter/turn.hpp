// Chooses, for the query in each lane, the component in which the weights are computed.
#pragma once

#include <cstddef>

#include "ccd/query/kind.hpp"
#include "ccd/query/lanes.hpp"
#include "oracle/arithmetic/double_word.hpp"
#include "oracle/filter/step_part.hpp"

namespace nearmiss::certified {

/// Permutes the components of vectors cyclically, so that the component in which the normal is largest at a
/// given time comes first. Only the other two components are kept, because they determine the weights in that
/// first component.
template <int n, Kind kind>
class Turn {
  using Real = Lanes<n>;
  using Word = DoubleWordOf<Real>;
  using Mask = typename Real::Mask;

 public:
  /// The arguments are the vectors at the given time. All of them may be multiplied by one common factor.
  Turn(const Vec<Real>& x21, const Vec<Real>& x31, const Vec<Real>& a) {
    const Vec<Real> x32 = x31 - x21;
    Vec<Real> normal;
    for (std::size_t k = 0; k < 3; ++k)
      normal[k] = abs(has_triangle(kind) ? cross_component(x21, x31, k) : cross_component(a, x32, k));
    first_ = !(normal[0] < max(normal[1], normal[2]));
    second_ = !(normal[1] < normal[2]);
  }

  template <class Number>
  [[nodiscard]] Weights<Number> weights(const StepPart<Number>& p) const {
    const auto turn = [&](const Motion<Number>& m) {
      return Motion<Number>{choose(m.start), choose(m.end), choose(m.magnitude), m.rounded_once,
                            m.rounded_once ? m.error : choose(m.error)};
    };
    return {kind, {p.begin, p.end, turn(p.a), turn(p.b), turn(p.c), turn(p.x21), turn(p.x31)}, 0};
  }

 private:
  [[nodiscard]] Real either(const Mask& mask, const Real& x, const Real& y) const {
    return select(mask, x, y);
  }
  [[nodiscard]] Word either(const Mask& mask, const Word& x, const Word& y) const {
    return {select(mask, x.hi, y.hi), select(mask, x.lo, y.lo)};
  }
  template <class Number>
  [[nodiscard]] Vec<Number> choose(const Vec<Number>& v) const {
    return {Number(0), either(first_, v[1], either(second_, v[2], v[0])),
            either(first_, v[2], either(second_, v[0], v[1]))};
  }

  Mask first_, second_;
};

}  // namespace nearmiss::certified
