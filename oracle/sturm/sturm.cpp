#include "oracle/sturm/sturm.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "ccd/arithmetic.hpp"
#include "oracle/sturm/integer_polynomial.hpp"

namespace nearmiss {

namespace sturm {
namespace {

/// A vector whose components are polynomials in t.
using IntegerPolynomialVector = std::array<IntegerPolynomial, 3>;

IntegerPolynomialVector operator-(const IntegerPolynomialVector& v, const IntegerPolynomialVector& w) {
  return {v[0] - w[0], v[1] - w[1], v[2] - w[2]};
}
IntegerPolynomial dot(const IntegerPolynomialVector& v, const IntegerPolynomialVector& w) {
  return v[0] * w[0] + v[1] * w[1] + v[2] * w[2];
}
IntegerPolynomialVector cross(const IntegerPolynomialVector& v, const IntegerPolynomialVector& w) {
  return {v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]};
}

/// A nonzero coordinate as an odd integer times a power of two.
struct OddMultiple {
  std::int64_t odd;
  int exponent;

  explicit OddMultiple(double coordinate) {
    const double fraction = std::frexp(coordinate, &exponent);
    odd = static_cast<std::int64_t>(std::ldexp(fraction, 53));
    const int zeros = std::countr_zero(static_cast<std::uint64_t>(odd));
    odd >>= zeros;
    exponent += zeros - 53;
  }
};

/// The largest power of two for each axis of which all its coordinates are multiples. Scaling an axis changes
/// no answer.
std::array<int, 3> exponents_of_units(const Query& query) {
  std::array<int, 3> smallest;
  smallest.fill(std::numeric_limits<int>::max());
  for (std::size_t i = 0; i < query.x.size(); ++i)
    if (query.x[i] != 0) smallest[i % 3] = std::min(smallest[i % 3], OddMultiple(query.x[i]).exponent);
  return smallest;
}

/// x_i in these units.
IntegerPolynomialVector moving_point(const Query& query, int i, const std::array<int, 3>& units) {
  const auto integer = [](double coordinate, int unit) {
    if (coordinate == 0) return Integer(0);
    const OddMultiple number(coordinate);
    return Integer(Integer(number.odd) << static_cast<unsigned>(number.exponent - unit));
  };
  IntegerPolynomialVector x;
  for (int k = 0; k < 3; ++k) {
    const int unit = units[static_cast<std::size_t>(k)];
    const Integer start = integer(query.start(i)[k], unit);
    const Integer end = integer(query.end(i)[k], unit);
    x[static_cast<std::size_t>(k)] = IntegerPolynomial({start, end - start});
  }
  return x;
}

/// The point x is on the closed segment from a to b iff `off_line`, a sum of squares, is zero and `beyond` is
/// not positive.
struct SegmentMembership {
  IntegerPolynomial off_line, beyond;

  SegmentMembership(const IntegerPolynomialVector& x, const IntegerPolynomialVector& a,
                    const IntegerPolynomialVector& b)
      : beyond(dot(x - a, x - b)) {
    const IntegerPolynomialVector c = cross(x - a, b - a);
    off_line = dot(c, c);
  }
};

/// The primitives of a query. If F = 0 and the area N·N is not zero, they meet iff every weight times N·N is
/// at least zero. For a triangle, x0 = λ1 x1 + λ2 x2 + λ3 x3 gives λi from the areas of the triangles with
/// x0, projected on N. For edges, x2 - x0 = α (x1 - x0) - β (x3 - x2) gives (x2 - x0) × (x3 - x2) = α N and
/// (x2 - x0) × (x1 - x0) = β N with N = (x1 - x0) × (x3 - x2). Most queries do not need all polynomials, so
/// each is computed on first use.
class Primitives {
 public:
  explicit Primitives(const Query& query) : kind_(query.kind) {
    const auto units = exponents_of_units(query);
    for (int i = 0; i < 4; ++i) x_[static_cast<std::size_t>(i)] = moving_point(query, i, units);
    const auto& [x0, x1, x2, x3] = x_;
    N_ = is_vertex_triangle() ? cross(x2 - x1, x3 - x1) : cross(x1 - x0, x3 - x2);
    F_ = dot(is_vertex_triangle() ? x0 - x1 : x2 - x0, N_);
  }

  [[nodiscard]] const IntegerPolynomial& F() const { return F_; }
  const IntegerPolynomial& area() {
    if (!area_) area_ = dot(N_, N_);
    return *area_;
  }
  const std::vector<IntegerPolynomial>& weights() {
    if (weights_.empty()) weights_ = make_weights();
    return weights_;
  }
  const std::vector<SegmentMembership>& segments() {
    if (segments_.empty()) segments_ = make_segments();
    return segments_;
  }

 private:
  [[nodiscard]] bool is_vertex_triangle() const { return kind_ == Kind::vertex_triangle; }

  [[nodiscard]] std::vector<IntegerPolynomial> make_weights() {
    const auto& [x0, x1, x2, x3] = x_;
    if (is_vertex_triangle())
      return {dot(cross(x2 - x0, x3 - x0), N_), dot(cross(x3 - x0, x1 - x0), N_),
              dot(cross(x1 - x0, x2 - x0), N_)};
    const IntegerPolynomial alpha = dot(cross(x2 - x0, x3 - x2), N_);
    const IntegerPolynomial beta = dot(cross(x2 - x0, x1 - x0), N_);
    return {alpha, area() - alpha, beta, area() - beta};
  }

  [[nodiscard]] std::vector<SegmentMembership> make_segments() const {
    const auto& [x0, x1, x2, x3] = x_;
    if (is_vertex_triangle()) return {{x0, x1, x2}, {x0, x2, x3}, {x0, x3, x1}};
    return {{x0, x2, x3}, {x1, x2, x3}, {x2, x0, x1}, {x3, x0, x1}};
  }

  Kind kind_;
  std::array<IntegerPolynomialVector, 4> x_;
  IntegerPolynomialVector N_;
  IntegerPolynomial F_;
  std::optional<IntegerPolynomial> area_;
  std::vector<IntegerPolynomial> weights_;
  std::vector<SegmentMembership> segments_;
};

enum class ContactPlace { none, inside, at_border };

ContactPlace contact_at(Primitives& primitives, const SturmRoot& t) {
  if (t.sign(primitives.area()) > 0) {
    int least = 1;
    for (const IntegerPolynomial& weight : primitives.weights()) {
      least = std::min(least, t.sign(weight));
      if (least < 0) return ContactPlace::none;
    }
    return least > 0 && !t.is_end() ? ContactPlace::inside : ContactPlace::at_border;
  }
  const bool any = std::any_of(
      primitives.segments().begin(), primitives.segments().end(),
      [&](const SegmentMembership& on) { return t.sign(on.off_line) == 0 && t.sign(on.beyond) <= 0; });
  return any ? ContactPlace::at_border : ContactPlace::none;
}

/// The multiplicity of the root t of F.
int multiplicity(const IntegerPolynomial& F, const SturmRoot& t) {
  int m = 1;
  for (IntegerPolynomial d = F.derivative(); !d.is_zero() && t.sign(d) == 0; d = d.derivative()) ++m;
  return m;
}

/// The times of which the first contact is one, if there is a contact: the roots of F. If F is identically zero, the set of
/// colliding times is closed, and its least element is 0 or a root of one of the polynomials whose signs decide. Calls
/// `holds` with each of these times until it returns true; returns whether it did.
template <class Holds>
bool any_candidate(Primitives& primitives, const Holds& holds) {
  const auto any_root = [&](const IntegerPolynomial& p) {
    const auto roots = roots_in_unit_interval(p);
    return std::any_of(roots.begin(), roots.end(), holds);
  };
  if (!primitives.F().is_zero()) return any_root(primitives.F());
  std::vector<const IntegerPolynomial*> deciding{&primitives.area()};
  for (const IntegerPolynomial& weight : primitives.weights()) deciding.push_back(&weight);
  for (const SegmentMembership& on : primitives.segments()) {
    deciding.push_back(&on.off_line);
    deciding.push_back(&on.beyond);
  }
  return holds(SturmRoot(Dyadic{0, 0})) ||
         std::any_of(deciding.begin(), deciding.end(),
                     [&](const IntegerPolynomial* p) { return !p->is_zero() && any_root(*p); });
}

/// A positive multiple of t - time.
IntegerPolynomial after(double time) {
  if (time == 0) return IntegerPolynomial({0, 1});
  const OddMultiple number(time);
  const Integer one = 1;
  return number.exponent < 0
             ? IntegerPolynomial({-Integer(number.odd), one << static_cast<unsigned>(-number.exponent)})
             : IntegerPolynomial({-(Integer(number.odd) << static_cast<unsigned>(number.exponent)), one});
}

}  // namespace
}  // namespace sturm

RootCount count_roots(const Query& query) {
  using namespace sturm;
  const PlainArithmetic guard;
  Primitives primitives(query);
  RootCount count;
  if (primitives.F().is_zero()) {
    count.planar = true;
    count.collision = any_candidate(
        primitives, [&](const SturmRoot& t) { return contact_at(primitives, t) != ContactPlace::none; });
    count.on_boundary = count.collision;
    return count;
  }
  for (const SturmRoot& t : roots_in_unit_interval(primitives.F())) {
    const ContactPlace place = contact_at(primitives, t);
    if (place == ContactPlace::none) continue;
    count.collision = true;
    count.on_boundary |= place == ContactPlace::at_border;
    ++count.distinct;
    count.with_multiplicity += multiplicity(primitives.F(), t);
  }
  return count;
}

bool meet_before(const Query& query, double time) {
  using namespace sturm;
  const PlainArithmetic guard;
  Primitives primitives(query);
  const IntegerPolynomial after_time = after(time);
  return any_candidate(primitives, [&](const SturmRoot& t) {
    return t.sign(after_time) < 0 && contact_at(primitives, t) != ContactPlace::none;
  });
}

}  // namespace nearmiss
