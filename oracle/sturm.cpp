#include "oracle/sturm.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "ccd/arithmetic.hpp"
#include "oracle/integer_polynomial.hpp"

namespace nearmiss {

namespace sturm {
namespace {

/// A vector whose components are polynomials in t.
using Vector = std::array<Polynomial, 3>;

Vector operator-(const Vector& v, const Vector& w) { return {v[0] - w[0], v[1] - w[1], v[2] - w[2]}; }
Polynomial dot(const Vector& v, const Vector& w) { return v[0] * w[0] + v[1] * w[1] + v[2] * w[2]; }
Vector cross(const Vector& v, const Vector& w) {
  return {v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]};
}

/// A coordinate other than zero as an odd integer times a power of two.
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

/// For each axis the largest power of two of which every coordinate along it is a multiple: scaling an axis
/// changes no answer.
std::array<int, 3> exponents_of_units(const Query& query) {
  std::array<int, 3> smallest;
  smallest.fill(std::numeric_limits<int>::max());
  for (std::size_t i = 0; i < query.x.size(); ++i)
    if (query.x[i] != 0) smallest[i % 3] = std::min(smallest[i % 3], OddMultiple(query.x[i]).exponent);
  return smallest;
}

/// x_i in these units.
Vector moving_point(const Query& query, int i, const std::array<int, 3>& units) {
  const auto integer = [](double coordinate, int unit) {
    if (coordinate == 0) return Integer(0);
    const OddMultiple number(coordinate);
    return Integer(Integer(number.odd) << static_cast<unsigned>(number.exponent - unit));
  };
  Vector x;
  for (int k = 0; k < 3; ++k) {
    const int unit = units[static_cast<std::size_t>(k)];
    const Integer start = integer(query.start(i)[k], unit);
    const Integer end = integer(query.end(i)[k], unit);
    x[static_cast<std::size_t>(k)] = Polynomial({start, end - start});
  }
  return x;
}

/// x lies on the closed segment from a to b iff `off_line`, a sum of squares, is zero and `beyond` is not
/// positive.
struct OnSegment {
  Polynomial off_line, beyond;

  OnSegment(const Vector& x, const Vector& a, const Vector& b) : beyond(dot(x - a, x - b)) {
    const Vector c = cross(x - a, b - a);
    off_line = dot(c, c);
  }
};

/// The primitives of a query. Where F = 0 and the area N·N is not zero, they meet iff every weight times N·N is
/// at least zero: x0 = λ1 x1 + λ2 x2 + λ3 x3 gives λi from the areas of the triangles with x0, projected on
/// N; x2 - x0 = α (x1 - x0) - β (x3 - x2) gives (x2 - x0) × (x3 - x2) = α N and (x2 - x0) × (x1 - x0) = β N
/// with N = (x1 - x0) × (x3 - x2). Most queries do not need all polynomials: each is made when first asked for.
class Primitives {
 public:
  explicit Primitives(const Query& query) : kind_(query.kind) {
    const auto units = exponents_of_units(query);
    for (int i = 0; i < 4; ++i) x_[static_cast<std::size_t>(i)] = moving_point(query, i, units);
    const auto& [x0, x1, x2, x3] = x_;
    N_ = is_vertex_triangle() ? cross(x2 - x1, x3 - x1) : cross(x1 - x0, x3 - x2);
    F_ = dot(is_vertex_triangle() ? x0 - x1 : x2 - x0, N_);
  }

  [[nodiscard]] const Polynomial& F() const { return F_; }
  const Polynomial& area() {
    if (!area_) area_ = dot(N_, N_);
    return *area_;
  }
  const std::vector<Polynomial>& weights() {
    if (weights_.empty()) weights_ = make_weights();
    return weights_;
  }
  const std::vector<OnSegment>& segments() {
    if (segments_.empty()) segments_ = make_segments();
    return segments_;
  }

 private:
  [[nodiscard]] bool is_vertex_triangle() const { return kind_ == Kind::vertex_triangle; }

  [[nodiscard]] std::vector<Polynomial> make_weights() {
    const auto& [x0, x1, x2, x3] = x_;
    if (is_vertex_triangle())
      return {dot(cross(x2 - x0, x3 - x0), N_), dot(cross(x3 - x0, x1 - x0), N_),
              dot(cross(x1 - x0, x2 - x0), N_)};
    const Polynomial alpha = dot(cross(x2 - x0, x3 - x2), N_);
    const Polynomial beta = dot(cross(x2 - x0, x1 - x0), N_);
    return {alpha, area() - alpha, beta, area() - beta};
  }

  [[nodiscard]] std::vector<OnSegment> make_segments() const {
    const auto& [x0, x1, x2, x3] = x_;
    if (is_vertex_triangle()) return {{x0, x1, x2}, {x0, x2, x3}, {x0, x3, x1}};
    return {{x0, x2, x3}, {x1, x2, x3}, {x2, x0, x1}, {x3, x0, x1}};
  }

  Kind kind_;
  std::array<Vector, 4> x_;
  Vector N_;
  Polynomial F_;
  std::optional<Polynomial> area_;
  std::vector<Polynomial> weights_;
  std::vector<OnSegment> segments_;
};

enum class Meeting { none, inside, at_border };

Meeting meeting_at(Primitives& primitives, const Root& t) {
  if (t.sign(primitives.area()) > 0) {
    int least = 1;
    for (const Polynomial& weight : primitives.weights()) {
      least = std::min(least, t.sign(weight));
      if (least < 0) return Meeting::none;
    }
    return least > 0 && !t.is_end() ? Meeting::inside : Meeting::at_border;
  }
  const bool any =
      std::any_of(primitives.segments().begin(), primitives.segments().end(),
                  [&](const OnSegment& on) { return t.sign(on.off_line) == 0 && t.sign(on.beyond) <= 0; });
  return any ? Meeting::at_border : Meeting::none;
}

/// How often t is a root of F.
int multiplicity(const Polynomial& F, const Root& t) {
  int m = 1;
  for (Polynomial d = F.derivative(); !d.is_zero() && t.sign(d) == 0; d = d.derivative()) ++m;
  return m;
}

/// F is zero identically: the set of colliding times is closed, and its least element is 0 or a root of one
/// of the polynomials whose signs decide.
bool collides_in_plane(Primitives& primitives) {
  std::vector<const Polynomial*> deciding{&primitives.area()};
  for (const Polynomial& weight : primitives.weights()) deciding.push_back(&weight);
  for (const OnSegment& on : primitives.segments()) {
    deciding.push_back(&on.off_line);
    deciding.push_back(&on.beyond);
  }
  if (meeting_at(primitives, Root(Dyadic{0, 0})) != Meeting::none) return true;
  return std::any_of(deciding.begin(), deciding.end(), [&](const Polynomial* p) {
    if (p->is_zero()) return false;
    const auto roots = roots_in_unit_interval(*p);
    return std::any_of(roots.begin(), roots.end(),
                       [&](const Root& t) { return meeting_at(primitives, t) != Meeting::none; });
  });
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
    count.collision = collides_in_plane(primitives);
    count.on_boundary = count.collision;
    return count;
  }
  for (const Root& t : roots_in_unit_interval(primitives.F())) {
    const Meeting meeting = meeting_at(primitives, t);
    if (meeting == Meeting::none) continue;
    count.collision = true;
    count.on_boundary |= meeting == Meeting::at_border;
    ++count.distinct;
    count.with_multiplicity += multiplicity(primitives.F(), t);
  }
  return count;
}

}  // namespace nearmiss
