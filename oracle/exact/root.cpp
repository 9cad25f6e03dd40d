#include "oracle/exact/root.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "oracle/arithmetic/doubles_around.hpp"
#include "oracle/exact/residues.hpp"

namespace nearmiss::exact {

namespace {

/// The exponent k of the denominator of x, which is 2^k.
std::ptrdiff_t exponent_of_denominator(const CGAL::Gmpq& x) {
  return static_cast<std::ptrdiff_t>(x.denominator().bit_size()) - 1;
}

/// The exponent of a power of two that is above |x|, but at most 2 |x|. x must not be zero.
std::ptrdiff_t exponent_above(const Number& x) {
  const CGAL::Gmpq fraction(x);
  return static_cast<std::ptrdiff_t>(fraction.numerator().bit_size()) - exponent_of_denominator(fraction);
}

/// The numbers in double, scaled by a power of two if the largest number is very large or small. At least one
/// number must not be zero.
std::vector<double> in_proportion(const Numbers& numbers) {
  std::vector<double> result;
  result.reserve(numbers.size());
  double largest = 0;
  for (const Number& x : numbers) {
    result.push_back(CGAL::to_double(x));
    largest = std::max(largest, std::abs(result.back()));
  }
  if (largest > 0x1p-500 && largest < 0x1p500) return result;
  std::ptrdiff_t exponent = std::numeric_limits<std::ptrdiff_t>::min();  // all are below 2^exponent
  for (const Number& x : numbers)
    if (!CGAL::is_zero(x)) exponent = std::max(exponent, exponent_above(x));
  const Number power(CGAL::Gmpz(1) << std::abs(exponent));
  std::transform(numbers.begin(), numbers.end(), result.begin(),
                 [&](const Number& x) { return CGAL::to_double(exponent < 0 ? x * power : x / power); });
  return result;
}

/// |x / y| rounded down; y must not be 0. CGAL converts only positive integers to the right Number, so 0 is
/// treated separately.
Number integer_quotient(const Number& x, const Number& y) {
  const CGAL::Gmpq a(x);
  const CGAL::Gmpq b(y);
  const std::ptrdiff_t shift = exponent_of_denominator(b) - exponent_of_denominator(a);
  const CGAL::Gmpz quotient = CGAL::abs((a.numerator() << std::max<std::ptrdiff_t>(shift, 0)) /
                                        (b.numerator() << std::max<std::ptrdiff_t>(-shift, 0)));
  return CGAL::is_zero(quotient) ? Number(0) : Number(quotient);
}

// The functions below represent a polynomial in double as OnInterval does: by the coefficients c_i of the
// terms s^i (1 - s)^(n - i). They are Bernstein coefficients times binomial coefficients.

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

}  // namespace

Number between(const Number& lo, const Number& hi, double part) { return lo + Number(part) * (hi - lo); }

Number power_of_half(unsigned bits) { return Number(1) / Number(CGAL::Gmpz(1) << bits); }

namespace {

/// Replaces the coefficients of a polynomial in powers of x, the leading one first, by its coefficients in
/// powers of x - shift.
template <class Multiply>
void shift(Numbers& c, const Multiply& times_shift) {
  for (std::size_t last = c.size() - 1; last > 0; --last)
    for (std::size_t i = 1; i <= last; ++i) c[i] = c[i] + times_shift(c[i - 1]);
}

/// Converts the coefficients of a polynomial in powers of t, the leading one first, to the coefficients that
/// OnInterval stores.
Numbers on_interval(Numbers&& c, const Number& lo, const Number& hi) {
  // First computes the coefficients of the powers of s. Here s is a fraction of the interval, counted from lo
  // or hi, whichever has fewer bits.
  constexpr std::size_t short_size = 4;  // if there are at most this many coefficients, s is counted from lo
  const bool from_hi = c.size() > short_size &&
                       exponent_of_denominator(CGAL::Gmpq(hi)) < exponent_of_denominator(CGAL::Gmpq(lo));
  const Number& from = from_hi ? hi : lo;
  const Number width = from_hi ? lo - hi : hi - lo;
  if (!CGAL::is_zero(from)) shift(c, [&](const Number& each) { return each * from; });
  std::reverse(c.begin(), c.end());
  if (width != 1) {
    Number power = 1;
    for (std::size_t i = 1; i < c.size(); ++i) {
      power = power * width;
      c[i] = c[i] * power;
    }
  }
  // The sum of a_i s^i equals the sum of a_i s^i (s + (1 - s))^(n - i).
  shift(c, [](const Number& each) -> const Number& { return each; });
  if (from_hi) std::reverse(c.begin(), c.end());
  return std::move(c);
}

/// Rounds x toward 0, to a multiple of 2^exponent. Returns whether the rounding has changed x.
bool round_off(Number& x, std::ptrdiff_t exponent) {
  const CGAL::Gmpq fraction(x);
  const std::ptrdiff_t denominator = exponent_of_denominator(fraction);
  if (denominator + exponent <= 0) return false;
  const CGAL::Gmpz multiple = CGAL::abs(fraction.numerator()) >> (denominator + exponent);
  const Number rounded = CGAL::is_zero(multiple)
                             ? Number(0)
                             : Number(multiple) * power_of_half(static_cast<unsigned>(-exponent));
  x = sign(x) < 0 ? -rounded : rounded;
  return true;
}

}  // namespace

OnInterval::OnInterval(const Polynomial& p, const Number& lo, const Number& hi)
    : c_(on_interval({p.coefficients().rbegin(), p.coefficients().rend()}, lo, hi)) {}

OnInterval OnInterval::part(const Number& from, const Number& to) const {
  Numbers powers = c_;
  shift(powers, [](const Number& each) { return -each; });
  std::reverse(powers.begin(), powers.end());
  OnInterval part(on_interval(std::move(powers), from, to));
  // Each Bernstein coefficient of the part is an average of those of the whole, with weights >= 0. So errors
  // do not grow.
  part.error_ = error_;
  return part;
}

void OnInterval::round() {
  constexpr std::ptrdiff_t kept_bits = 6'144;
  std::ptrdiff_t largest = std::numeric_limits<std::ptrdiff_t>::min();
  for (const Number& c : c_)
    if (!CGAL::is_zero(c)) largest = std::max(largest, exponent_above(c));
  const std::ptrdiff_t least = std::max(largest - kept_bits, error_.value_or(largest - kept_bits));
  bool is_rounded = false;
  for (Number& c : c_) is_rounded = (least < 0 && round_off(c, least)) || is_rounded;
  if (is_rounded) error_ = least + 1;
}

bool OnInterval::is_certain() const {
  const auto least = static_cast<std::ptrdiff_t>(c_.size()) + 2;  // no binomial coefficient is above 2^n
  return !error_ || std::all_of(c_.begin(), c_.end(), [&](const Number& c) {
    return !CGAL::is_zero(c) && exponent_above(c) > *error_ + least;
  });
}

int OnInterval::only_sign() const {
  if (changes() > 0) return 0;
  for (const Number& c : c_)
    if (const int s = sign(c); s != 0) return s;
  return 0;
}

Number OnInterval::operator()(const Number& s) const {
  const Number rest = Number(1) - s;
  Number value = c_[0];
  Number power = s;
  for (std::size_t i = 1; i < c_.size(); ++i) {
    value = value * rest + power * c_[i];
    power = power * s;
  }
  return value;
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
  // This is Newton's method, which converges only linearly if two roots are close to each other.
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

std::optional<Number> OnInterval::guess_cluster(unsigned bits) const {
  const int n = static_cast<int>(c_.size()) - 1;
  // A step of Schröder's method, which is Newton's for f / f', from the lower end. f0, f1 and f2 are the
  // value of f and its first two derivatives at this end.
  const Number& f0 = c_[0];
  const Number f1 = c_[1] - Number(n) * f0;
  const Number f2 = Number(2) * (c_[2] - Number(n - 1) * c_[1]) + Number(n * (n - 1)) * f0;
  const Number denominator = f1 * f1 - f0 * f2;
  const Number numerator = -f0 * f1;
  if (sign(numerator) * sign(denominator) <= 0) return std::nullopt;
  const Number unit = power_of_half(bits);
  const Number guess = unit * integer_quotient(numerator, denominator * unit);
  if (guess > 1) return std::nullopt;
  return guess;
}

std::optional<OnInterval::NearEnd> OnInterval::roots_near_end() const {
  // If the roots are at least 2^near away from the ends of the interval, cuts at doubles suffice.
  constexpr std::ptrdiff_t near = -40;
  using Exponents = std::vector<std::ptrdiff_t>;
  Exponents exponents;
  for (const Number& c : c_) exponents.push_back(CGAL::is_zero(c) ? 0 : exponent_above(c));
  // With x = s / (1 - s), the sum of c_i x^i has the same roots. If c_n > 0, the sum is positive for x >= 2
  // max (-c_i / c_n)^(1 / (n - i)) over the negative c_i, because -c_i x^i is then at most c_n x^n / 2^(n -
  // i).
  const auto above_roots = [n = c_.size() - 1](const auto& c, const auto& exponent) {
    std::ptrdiff_t most = std::numeric_limits<std::ptrdiff_t>::min();
    for (std::size_t i = 0; i < n; ++i) {
      if (sign(c[i]) * sign(c[n]) >= 0) continue;
      const auto steps = static_cast<std::ptrdiff_t>(n - i);
      const std::ptrdiff_t ratio = exponent[i] - exponent[n] + 2;                  // 1 for rounding
      most = std::max(most, 1 + (ratio > 0 ? ratio + steps - 1 : ratio) / steps);  // rounded up
    }
    return most;
  };
  const std::ptrdiff_t most = above_roots(c_.begin(), exponents.begin());
  const std::ptrdiff_t most_inverse = above_roots(c_.rbegin(), exponents.rbegin());  // of 1 / x
  if (most <= -most_inverse) return NearEnd{0, 0, 0};
  if (std::min(most, most_inverse) >= near) return std::nullopt;
  // s < x and, for x < 1, s > x / 2. Likewise, 1 - s < 1 / x and, for x > 1, 1 - s > 1 / (2 x).
  const std::ptrdiff_t upper = std::min(most, most_inverse);
  const std::ptrdiff_t lower = -std::max(most, most_inverse);
  const auto power = [](std::ptrdiff_t exponent) { return power_of_half(static_cast<unsigned>(-exponent)); };
  NearEnd at{power(lower - 1), power(std::midpoint(lower, upper)), power(upper)};
  if (most_inverse < most) at = {Number(1) - at.upper, Number(1) - at.middle, Number(1) - at.lower};
  return at;
}

/// Cuts the interval at `at`, which must be inside, and keeps the part with the root.
void Root::cut(const Number& at) {
  const int side = p_->sign_at(at);
  if (side == 0)
    *this = Root(at);
  else
    (side == sign_at_lo_ ? lo_ : hi_) = at;
}

/// Replaces the polynomial by p, and the interval by (lo, hi). This root must be the only root of p in (lo,
/// hi), and a simple root of p.
void Root::take(std::shared_ptr<const Polynomial> p, Number lo, Number hi) {
  p_ = std::move(p);
  lo_ = std::move(lo);
  hi_ = std::move(hi);
  sign_at_lo_ = p_->sign_at(lo_);
}

void Root::refine() {
  if (is_number()) return;
  ++refinements_;
  const Number lo = lo_;
  const Number width = hi_ - lo_;
  const OnInterval on(*p_, lo_, hi_);
  const double s = on.guess_root(sign_at_lo_);
  if (std::min(s, 1 - s) < around) {
    if (const auto near_end = on.roots_near_end()) {
      lo_ = lo + near_end->lower * width;
      hi_ = lo + near_end->upper * width;
      return;
    }
  }
  Number guess = Number(s);
  Number unit = Number(around);
  // In a small interval, the polynomial is nearly linear. So a step along the chord between its values at the
  // ends of the interval gives many more digits of the root.
  if (chord_steps_ > 1) {
    for (int i = 1; i < chord_steps_; ++i) unit = unit * Number(around);
    const Number value = on(guess);
    const Number step = unit * integer_quotient(value, on.rise() * unit);
    guess = sign(value) == sign(on.rise()) ? guess - step : guess + step;
  }
  guess = lo + guess * width;
  unit = unit * width;
  const Number radius = Number(8) * unit;
  const Number below = guess - radius;
  const Number above = guess + radius;
  // First cuts at the simplest number near the guess: roots are often numbers of few bits, and the sign at
  // such a number is fast to compute.
  for (const Number& at :
       {Number(certified::simplest_between(CGAL::to_double(below), CGAL::to_double(above))), below, above})
    if (!is_number() && lo_ < at && at < hi_) cut(at);
  const bool found = hi_ - lo_ <= Number(2) * radius;
  chord_steps_ = found ? std::min(2 * chord_steps_, 64) : 1;
  if (Number(2) * (hi_ - lo_) > width) cut(between(lo_, hi_, 0.5));
}

namespace {

/// Requires that p has at most one root between lo and hi, that this root is simple, and that p and q are not
/// both zero at lo or at hi. If this root of p is also a root of q, returns a polynomial that has the root:
/// the greatest common divisor of p and q if its degree is lower than that of p, else p. Otherwise returns
/// nothing. The divisor has the root iff its signs at lo and hi differ.
std::shared_ptr<const Polynomial> with_common_root(const Polynomial& p, const Polynomial& q, const Number& lo,
                                                   const Number& hi) {
  // Up to this degree, the greatest common divisor is found faster than residues are tested.
  constexpr int short_degree = 3;
  if (std::max(p.degree(), q.degree()) > short_degree && are_coprime_by_residues(p, q)) return nullptr;
  Polynomial common = greatest_common_divisor(p, q);
  if (common.degree() < 1 || common.sign_at(lo) == common.sign_at(hi)) return nullptr;
  return std::make_shared<const Polynomial>(common.degree() < p.degree() ? primitive(common) : p);
}

}  // namespace

int Root::sign_of(const Polynomial& q) {
  if (q.degree() < 1) return q.is_zero() ? 0 : sign(q.leading());
  if (!is_number() && are_proportional(*p_, q)) return 0;
  // One refinement narrows the interval by 44 bits, after which a sign that is not zero nearly always shows.
  constexpr int patience = 1;
  for (bool can_be_zero = true;;) {
    if (is_number()) return q.sign_at(lo_);
    if (const int s = OnInterval(q, lo_, hi_).only_sign(); s != 0) return s;
    if (can_be_zero && refinements_ >= patience) {
      if (const auto common = with_common_root(*p_, q, lo_, hi_)) {
        take(common, lo_, hi_);
        return 0;
      }
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

bool Root::is_same(Root& other) {
  if (other.is_number()) return is(other.lo_);
  if (is_number()) return other.is(lo_);
  // Each polynomial has at most one root in the intersection of both intervals, and none at the ends of its
  // own interval.
  const Number& lo = std::max(lo_, other.lo_);
  const Number& hi = std::min(hi_, other.hi_);
  if (!(lo < hi)) return false;
  const auto common = with_common_root(*p_, *other.p_, lo, hi);
  if (!common) return false;
  take(common, lo, hi);
  other.take(common, lo_, hi_);
  return true;
}

bool Root::is_below(Root& other) {
  if (is_same(other)) return false;
  while (hi_ > other.lo_ && other.hi_ > lo_) (other.hi_ - other.lo_ < hi_ - lo_ ? *this : other).refine();
  return hi_ <= other.lo_;
}

}  // namespace nearmiss::exact
