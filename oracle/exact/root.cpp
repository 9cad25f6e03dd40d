#include "oracle/exact/root.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "oracle/exact/residues.hpp"

namespace nearmiss::exact {

namespace {

/// The relative accuracy with which double locates a well-conditioned place in an interval.
constexpr double around = 0x1p-44;

/// The numbers in double, scaled by a power of two that brings the largest near 1; not all may be zero.
std::vector<double> in_proportion(const Numbers& numbers) {
  std::vector<double> result;
  result.reserve(numbers.size());
  double largest = 0;
  for (const Number& x : numbers) {
    result.push_back(CGAL::to_double(x));
    largest = std::max(largest, std::abs(result.back()));
  }
  if (largest > 0x1p-500 && largest < 0x1p500) return result;
  Numbers scaled;
  for (const Number& x : numbers) scaled.push_back(x * Number(largest < 1 ? 0x1p800 : 0x1p-800));
  return in_proportion(scaled);
}

// The functions below represent a polynomial in double as OnInterval does: by the c_i of s^i (1 - s)^(n - i),
// its Bernstein coefficients times binomial coefficients.

std::vector<double> derivative(const std::vector<double>& c) {
  const std::size_t n = c.size() - 1;
  std::vector<double> d;
  for (std::size_t i = 0; i < n; ++i)
    d.push_back(static_cast<double>(i + 1) * c[i + 1] - static_cast<double>(n - i) * c[i]);
  return d;
}

double value_at(const std::vector<double>& c, double s) {
  double value = c[0];
  double power = 1;
  for (std::size_t i = 1; i < c.size(); ++i) {
    power *= s;
    value = value * (1 - s) + power * c[i];
  }
  return value;
}

/// x / y, clamped to ±2^60.
double ratio(const Number& x, const Number& y) {
  const std::vector<double> both = in_proportion({x, y});
  return std::clamp(both[0] / both[1], -0x1p60, 0x1p60);
}

/// lo + part (hi - lo).
Number between(const Number& lo, const Number& hi, double part) { return lo + Number(part) * (hi - lo); }

/// Guesses the number with the fewest bits between two positive numbers: the higher number, truncated after
/// the first of 53 bits in which the two differ. If none of the 53 differs, the result is the higher number.
double simplest_between(const Number& lower, const Number& higher) {
  const double lo = CGAL::to_double(lower);
  const double hi = CGAL::to_double(higher);
  if (!(0 < lo && lo < hi)) return hi;
  const int unit = std::ilogb(hi) - 52;
  const auto a = static_cast<std::uint64_t>(std::ldexp(lo, -unit));
  const auto b = static_cast<std::uint64_t>(std::ldexp(hi, -unit));
  const std::uint64_t kept = a == b ? ~std::uint64_t{0} : ~(std::bit_floor(a ^ b) - 1);
  return std::ldexp(static_cast<double>(b & kept), unit);
}

/// The roots in (0, 1) of a polynomial that is not zero at 0 or 1, in ascending order; or one root that was
/// found as a number; or neither, if the search gave up.
struct Isolated {
  std::vector<Root> roots;
  std::optional<Number> number;
  bool found = true;
};

/// The number of bits from the highest one of any coefficient to the lowest one of any.
std::size_t bits_of(const Polynomial& p) {
  std::ptrdiff_t above = 0;
  std::ptrdiff_t below = 0;
  for (const Number& c : p.coefficients()) {
    if (CGAL::is_zero(c)) continue;
    const CGAL::Gmpq fraction(c);
    const auto size = [](const CGAL::Gmpz& n) { return static_cast<std::ptrdiff_t>(n.bit_size()); };
    above = std::max(above, size(fraction.numerator()) - size(fraction.denominator()) + 1);
    below = std::max(below, size(fraction.denominator()) - 1);
  }
  return static_cast<std::size_t>(above + below);
}

/// The only extremum of a polynomial in an interval, as a root of the derivative.
struct Extremum {
  Root root;
  int refinements = 0;
};

std::shared_ptr<Extremum> only_extremum(const Polynomial& p, const Number& lo, const Number& hi) {
  const auto slope = std::make_shared<const Polynomial>(p.derivative());
  if (OnInterval(*slope, lo, hi).changes() != 1 || slope->sign_at(lo) == 0 || slope->sign_at(hi) == 0)
    return nullptr;
  return std::make_shared<Extremum>(Extremum{Root(slope, lo, hi)});
}

/// The number of refinements of an extremum after which a pair of roots beside it is probably a double root: each doubles its
/// bits, and different roots are hardly ever nearer than twice the bits of the coefficients.
int worthwhile_refinements(const Polynomial& p) {
  constexpr std::size_t first_bits = 41;
  return static_cast<int>(std::bit_width(2 * bits_of(p) / first_bits + 1));
}

/// Cuts the interval until every part has at most one root, and that is simple. It cuts alternately near an extremum, since two
/// close roots have one between them, and in the middle. The extremum is guessed at first; if that does not help, it is
/// enclosed, in an interval whose bits double. Unless the polynomial is known to have no multiple roots, it gives up after a few
/// cuts, or when there probably is a double root.
Isolated isolate(const std::shared_ptr<const Polynomial>& p, bool is_simple) {
  struct Subinterval {
    Number lo, hi;
    bool guess;
    std::shared_ptr<Extremum> extremum = nullptr;
  };
  constexpr int few = 12;
  constexpr int guesses = 2;
  int most_refinements = 0;
  Isolated isolated;
  std::vector<Subinterval> parts{{0, 1, true}};  // a stack with the lowest part on top
  for (int cuts = 0; !parts.empty();) {
    const Subinterval part = std::move(parts.back());
    parts.pop_back();
    const OnInterval on(*p, part.lo, part.hi);
    const int changes = on.changes();
    if (changes == 1) isolated.roots.emplace_back(p, part.lo, part.hi);
    if (changes < 2) continue;
    if (++cuts > few && !is_simple) return {{}, {}, false};
    std::shared_ptr<Extremum> extremum = part.extremum;
    if (!extremum && part.guess && cuts > guesses) extremum = only_extremum(*p, part.lo, part.hi);
    Numbers at;
    if (extremum) {
      if (most_refinements == 0) most_refinements = worthwhile_refinements(*p);
      if (++extremum->refinements > most_refinements && !is_simple) return {{}, {}, false};
      extremum->root.refine();
      at = {extremum->root.hi(), extremum->root.lo()};
    } else {
      const double guess = part.guess ? on.guess_extremum() : 0.5;
      const double around_it = part.guess ? around : 0;
      at = {between(part.lo, part.hi, guess + around_it), between(part.lo, part.hi, guess - around_it)};
    }
    const auto of_part = [&](const Number& lo, const Number& hi) {
      const bool is_inside = extremum && extremum->root.lo() < extremum->root.hi() &&
                             lo <= extremum->root.lo() && extremum->root.hi() <= hi;
      return is_inside ? extremum : nullptr;
    };
    Number hi = part.hi;
    for (const Number& lo : at) {
      if (!(part.lo < lo && lo < hi)) continue;
      if (p->sign_at(lo) == 0) return {{}, lo};
      parts.push_back({lo, hi, !part.guess, of_part(lo, hi)});
      hi = lo;
    }
    parts.push_back({part.lo, hi, !part.guess, of_part(part.lo, hi)});
  }
  return isolated;
}

}  // namespace

OnInterval::OnInterval(const Polynomial& p, const Number& lo, const Number& hi) {
  // The coefficients of (1 + x)^n p((lo + hi x) / (1 + x)), by Horner's scheme: c becomes c (lo + hi x) + a_i
  // (1 + x)^(n - i).
  c_.reserve(p.coefficients().size());
  c_.push_back(p.leading());
  for (auto i = static_cast<std::size_t>(p.degree()); i-- > 0;) {
    const Number& a = p.coefficients()[i];
    const std::size_t last = c_.size();
    c_.push_back(c_.back() * hi + a);
    std::size_t binomial = 1;
    for (std::size_t k = last - 1; k > 0; --k) {
      binomial = binomial * (k + 1) / (last - k);
      c_[k] = c_[k] * lo + c_[k - 1] * hi + a * Number(binomial);
    }
    c_[0] = c_[0] * lo + a;
  }
}

int OnInterval::only_sign() const {
  if (changes() > 0) return 0;
  for (const Number& c : c_)
    if (const int s = sign(c); s != 0) return s;
  return 0;
}

double OnInterval::guess_root(int sign_at_lo) const {
  const std::vector<double> c = in_proportion(c_);
  double lo = 0;
  double hi = 1;
  for (int i = 0; i < 52; ++i) {
    const double middle = 0.5 * (lo + hi);
    const double value = value_at(c, middle);
    ((value > 0) - (value < 0) == sign_at_lo ? lo : hi) = middle;
  }
  return 0.5 * (lo + hi);
}

double OnInterval::guess_extremum() const {
  const std::vector<double> slope = derivative(in_proportion(c_));
  const std::vector<double> bend = derivative(slope);
  double s = 0.5;
  // Newton's method; it converges only linearly if two roots are close.
  for (int i = 0; i < 60; ++i) {
    const double value = value_at(slope, s);
    if (value == 0) break;
    const double next = std::clamp(s - value / value_at(bend, s), 0.0, 1.0);
    if (std::isnan(next)) return 0.5;
    const bool stands = std::abs(next - s) < 0x1p-48;
    s = next;
    if (stands) break;
  }
  return s;
}

Root::Root(std::shared_ptr<const Polynomial> p, const Number& lo, const Number& hi)
    : p_(std::move(p)), lo_(lo), hi_(hi), sign_at_lo_(p_->sign_at(lo)) {}

/// Cuts the interval at `at`, which must be inside, and keeps the part with the root.
void Root::cut(const Number& at) {
  const int side = p_->sign_at(at);
  if (side == 0)
    *this = Root(at);
  else
    (side == sign_at_lo_ ? lo_ : hi_) = at;
}

void Root::refine() {
  if (is_number()) return;
  ++refinements_;
  const Number lo = lo_;
  const Number width = hi_ - lo_;
  const OnInterval on(*p_, lo_, hi_);
  // In a small interval p is nearly linear, so each step along the chord gives some more digits of the root.
  Number guess = lo + Number(on.guess_root(sign_at_lo_)) * width;
  Number unit = width;
  Number magnifier = 1;
  for (int i = 1; i < chord_steps_; ++i) {
    unit = unit * Number(around);
    magnifier = magnifier * Number(1 / around);
    guess = guess - unit * Number(ratio((*p_)(guess)*magnifier, on.rise()));
  }
  const Number radius = unit * Number(8 * around);
  const Number below = guess - radius;
  const Number above = guess + radius;
  // Roots are often numbers of few bits, and signs at such numbers are fast to compute.
  for (const Number& at : {Number(simplest_between(below, above)), below, above})
    if (!is_number() && lo_ < at && at < hi_) cut(at);
  const bool found = hi_ - lo_ <= Number(2) * radius;
  chord_steps_ = found ? std::min(2 * chord_steps_, 64) : 1;
  if (Number(2) * (hi_ - lo_) > width) cut(between(lo_, hi_, 0.5));
}

namespace {

/// Whether residues show this; for short polynomials, a divisor takes less time.
bool have_no_common_root(const Polynomial& p, const Polynomial& q) {
  constexpr int short_degree = 3;
  return std::max(p.degree(), q.degree()) > short_degree && are_coprime_by_residues(p, q);
}

}  // namespace

/// p has only one root here, and it is simple; a divisor of p has the same root if and only if its sign
/// changes there.
bool Root::is_root_of(const Polynomial& q) const {
  if (have_no_common_root(*p_, q)) return false;
  const Polynomial common = greatest_common_divisor(*p_, q);
  return common.degree() > 0 && common.sign_at(lo_) != common.sign_at(hi_);
}

int Root::sign_of(const Polynomial& q) {
  if (q.degree() < 1) return q.is_zero() ? 0 : sign(q.leading());
  if (!is_number() && are_proportional(*p_, q)) return 0;
  constexpr int patience = 2;  // two times 44 bits nearly always show a nonzero sign
  for (bool can_be_zero = true;;) {
    if (is_number()) return q.sign_at(lo_);
    if (const int s = OnInterval(q, lo_, hi_).only_sign(); s != 0) return s;
    if (can_be_zero && refinements_ >= patience) {
      if (is_root_of(q)) return 0;
      can_be_zero = false;
    }
    refine();
  }
}

bool Root::is(const Number& number) const {
  if (is_number()) return lo_ == number;
  return lo_ < number && number < hi_ && p_->sign_at(number) == 0;
}

std::optional<CGAL::Gmpq> Root::as_rational() {
  using CGAL::Gmpq;
  using CGAL::Gmpz;
  if (is_number()) return Gmpq(lo_);
  // Once a power of two has made all coefficients integers, the denominator of a rational root divides the
  // leading coefficient.
  Gmpz multiple = 1;
  for (const Number& a : p_->coefficients()) multiple = std::max(multiple, Gmpq(a).denominator());
  const Gmpz denominator = (Gmpq(p_->leading()) * Gmpq(multiple)).numerator();
  const Gmpq size = CGAL::abs(Gmpq(denominator));
  while (!is_number() && size * Gmpq(hi_ - lo_) >= 1) refine();
  if (is_number()) return Gmpq(lo_);
  // There is at most one multiple of 1 / size in the open interval.
  const Gmpq lowest = size * Gmpq(lo_);
  Gmpz above;
  mpz_fdiv_q(above.mpz(), lowest.numerator().mpz(), lowest.denominator().mpz());
  const Gmpq t = Gmpq(above + 1) / size;
  Gmpq value = 0;
  for (int i = p_->degree(); i >= 0; --i)
    value = value * t + Gmpq(p_->coefficients()[static_cast<std::size_t>(i)]);
  if (t < Gmpq(hi_) && CGAL::is_zero(value)) return t;
  return std::nullopt;
}

bool Root::is_same(const Root& other) const {
  if (other.is_number()) return is(other.lo_);
  if (is_number()) return other.is(lo_);
  // Each polynomial has at most one root in the intersection of both intervals, and none at the ends of its
  // own interval.
  const Number& lo = std::max(lo_, other.lo_);
  const Number& hi = std::min(hi_, other.hi_);
  if (hi <= lo || have_no_common_root(*p_, *other.p_)) return false;
  const Polynomial common = greatest_common_divisor(*p_, *other.p_);
  return common.degree() > 0 && common.sign_at(lo) != common.sign_at(hi);
}

bool Root::is_below(Root& other) {
  if (is_same(other)) return false;
  while (hi_ > other.lo_ && other.hi_ > lo_) (other.hi_ - other.lo_ < hi_ - lo_ ? *this : other).refine();
  return hi_ <= other.lo_;
}

std::vector<Root> roots_in_step(const Polynomial& p) {
  auto rest = std::make_shared<const Polynomial>(p);
  std::vector<Root> numbers;
  const auto take_out = [&](const Number& root) {
    numbers.emplace_back(root);
    while (rest->degree() > 0 && rest->sign_at(root) == 0)
      rest = std::make_shared<const Polynomial>(divide(*rest, Polynomial({-root, Number(1)})).quotient);
  };
  for (const Number& end : {Number(0), Number(1)})
    if (rest->degree() > 0 && rest->sign_at(end) == 0) take_out(end);
  // Tries a few cuts first. If these do not separate the roots, some may be multiple roots.
  std::vector<Root> roots;
  for (bool is_simple = false; rest->degree() > 0;) {
    Isolated isolated = isolate(rest, is_simple);
    if (isolated.number) {
      take_out(*isolated.number);
    } else if (isolated.found) {
      roots = std::move(isolated.roots);
      break;
    } else {
      rest = std::make_shared<const Polynomial>(square_free(*rest));
      is_simple = true;
    }
  }
  for (Root& number : numbers)
    roots.insert(std::find_if(roots.begin(), roots.end(), [&](Root& root) { return number.is_below(root); }),
                 number);
  return roots;
}

}  // namespace nearmiss::exact
