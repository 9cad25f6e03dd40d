#include "oracle/sturm/integer_polynomial.hpp"

#include <algorithm>

namespace nearmiss::sturm {

namespace {

/// The number of changes between the signs of successive elements, zeros left out.
template <class Sequence, class Sign>
int variations(const Sequence& sequence, const Sign& sign_of) {
  int changes = 0;
  int last = 0;
  for (const auto& each : sequence) {
    const int sign = sign_of(each);
    if (sign == 0) continue;
    changes += last != 0 && sign != last ? 1 : 0;
    last = sign;
  }
  return changes;
}

}  // namespace

bool operator<(const Dyadic& a, const Dyadic& b) {
  if (a.exponent < b.exponent) return (a.numerator << (b.exponent - a.exponent)) < b.numerator;
  return a.numerator < (b.numerator << (a.exponent - b.exponent));
}

IntegerPolynomial::IntegerPolynomial(std::vector<Integer> coefficients) : c_(std::move(coefficients)) {
  while (!c_.empty() && c_.back() == 0) c_.pop_back();
}

int IntegerPolynomial::sign_at(const Dyadic& t) const {
  Integer value = 0;  // the value times 2^(exponent × degree)
  unsigned shift = 0;
  for (auto c = c_.rbegin(); c != c_.rend(); ++c) {
    value = value * t.numerator + (*c << shift);
    shift += t.exponent;
  }
  return value.sign();
}

int IntegerPolynomial::sign_on(const Dyadic& lo, const Dyadic& hi) const {
  const unsigned exponent = std::max(lo.exponent, hi.exponent);
  const Integer from = lo.numerator << (exponent - lo.exponent);
  const Integer to = hi.numerator << (exponent - hi.exponent);
  // Bounds of the value times 2^(exponent × degree).
  Integer least = 0;
  Integer most = 0;
  unsigned shift = 0;
  for (auto c = c_.rbegin(); c != c_.rend(); ++c) {
    const Integer next = *c << shift;
    least = least * (least < 0 ? to : from) + next;
    most = most * (most < 0 ? from : to) + next;
    shift += exponent;
  }
  return least > 0 ? 1 : most < 0 ? -1 : 0;
}

// The roots of f in (0, 1) are those of (1 + t)^degree f(1 / (1 + t)) for t > 0: its coefficients are those of f in reverse
// order, as a polynomial in 1 + t.
int IntegerPolynomial::most_roots_inside() const {
  std::vector<Integer> shifted(c_.rbegin(), c_.rend());
  for (std::size_t i = 0; i + 1 < shifted.size(); ++i)
    for (std::size_t j = shifted.size() - 1; j > i; --j) shifted[j - 1] += shifted[j];
  return variations(shifted, [](const Integer& c) { return c.sign(); });
}

IntegerPolynomial IntegerPolynomial::derivative() const {
  std::vector<Integer> d;
  for (std::size_t i = 1; i < c_.size(); ++i) d.emplace_back(c_[i] * i);
  return IntegerPolynomial(std::move(d));
}

IntegerPolynomial IntegerPolynomial::operator+(const IntegerPolynomial& other) const {
  std::vector<Integer> sum(std::max(c_.size(), other.c_.size()));
  for (std::size_t i = 0; i < c_.size(); ++i) sum[i] = c_[i];
  for (std::size_t i = 0; i < other.c_.size(); ++i) sum[i] += other.c_[i];
  return IntegerPolynomial(std::move(sum));
}

IntegerPolynomial IntegerPolynomial::operator-() const {
  std::vector<Integer> negative;
  for (const Integer& c : c_) negative.emplace_back(-c);
  return IntegerPolynomial(std::move(negative));
}

IntegerPolynomial IntegerPolynomial::operator-(const IntegerPolynomial& other) const {
  std::vector<Integer> difference(std::max(c_.size(), other.c_.size()));
  for (std::size_t i = 0; i < c_.size(); ++i) difference[i] = c_[i];
  for (std::size_t i = 0; i < other.c_.size(); ++i) difference[i] -= other.c_[i];
  return IntegerPolynomial(std::move(difference));
}

IntegerPolynomial IntegerPolynomial::operator*(const IntegerPolynomial& other) const {
  if (is_zero() || other.is_zero()) return {};
  std::vector<Integer> product(c_.size() + other.c_.size() - 1);
  for (std::size_t i = 0; i < c_.size(); ++i)
    for (std::size_t j = 0; j < other.c_.size(); ++j) product[i + j] += c_[i] * other.c_[j];
  return IntegerPolynomial(std::move(product));
}

// Every step multiplies the dividend by the absolute value of the divisor's leading coefficient, which
// preserves signs. `with_quotient` receives each coefficient of the quotient and must multiply all earlier
// ones in the same way.
template <class WithQuotient>
void IntegerPolynomial::divide_by(const IntegerPolynomial& other, const WithQuotient& with_quotient) {
  const std::size_t n = other.c_.size();
  const Integer lead = abs(other.c_.back());
  const bool is_negative = other.c_.back().sign() < 0;
  while (c_.size() >= n) {
    Integer top = std::move(c_.back());
    c_.pop_back();
    if (is_negative) top = -top;
    if (top.is_zero()) continue;
    const std::size_t shift = c_.size() + 1 - n;
    for (Integer& each : c_) each *= lead;
    for (std::size_t j = 0; j + 1 < n; ++j) c_[shift + j] -= top * other.c_[j];
    with_quotient(shift, lead, std::move(top));
  }
}

IntegerPolynomial IntegerPolynomial::primitive() && {
  Integer common = 0;
  for (const Integer& c : c_) {
    common = gcd(common, c);
    if (common == 1) break;
  }
  if (common != 1)
    for (Integer& c : c_) c /= common;
  return IntegerPolynomial(std::move(c_));
}

IntegerPolynomial IntegerPolynomial::remainder(const IntegerPolynomial& other) const {
  IntegerPolynomial rest = *this;
  rest.divide_by(other, [](std::size_t, const Integer&, Integer&&) {});
  return IntegerPolynomial(std::move(rest.c_)).primitive();
}

IntegerPolynomial IntegerPolynomial::quotient(const IntegerPolynomial& other) const {
  IntegerPolynomial rest = *this;
  std::vector<Integer> quotient(c_.size() >= other.c_.size() ? c_.size() - other.c_.size() + 1 : 0);
  rest.divide_by(other, [&](std::size_t i, const Integer& lead, Integer&& top) {
    for (Integer& each : quotient) each *= lead;
    quotient[i] = std::move(top);
  });
  return IntegerPolynomial(std::move(quotient)).primitive();
}

namespace {

/// The signed remainder sequence of f and g, each up to a positive factor.
std::vector<IntegerPolynomial> remainder_sequence(const IntegerPolynomial& f, const IntegerPolynomial& g) {
  std::vector<IntegerPolynomial> sequence{f, g};
  while (!sequence.back().is_zero())
    sequence.push_back(-sequence[sequence.size() - 2].remainder(sequence.back()));
  sequence.pop_back();
  return sequence;
}

int sign_variations(const std::vector<IntegerPolynomial>& sequence, const Dyadic& t) {
  return variations(sequence, [&](const IntegerPolynomial& p) { return p.sign_at(t); });
}

/// Tarski's query: the sum over the distinct roots of f in (lo, hi) of the sign of g there; f is not zero at
/// the ends. The result depends on g only modulo f.
int tarski_query(const IntegerPolynomial& f, const IntegerPolynomial& g, const Dyadic& lo, const Dyadic& hi) {
  const auto sequence =
      remainder_sequence(f, f.derivative() * (g.degree() < f.degree() ? g : g.remainder(f)));
  return sign_variations(sequence, lo) - sign_variations(sequence, hi);
}

/// f divided by the factor of its simple root t.
IntegerPolynomial without_root(const IntegerPolynomial& f, const Dyadic& t) {
  return f.quotient(IntegerPolynomial({-t.numerator, Integer(1) << t.exponent}));
}

/// The integer e with 2^e <= x < 2^(e + 1), for x > 0.
int magnitude(const Dyadic& x) { return static_cast<int>(msb(x.numerator)) - static_cast<int>(x.exponent); }

Dyadic power_of_half(int exponent) { return {1, static_cast<unsigned>(exponent)}; }

/// A number between a and b, for 0 <= a < b <= 1. If their magnitudes are far apart, it is in the middle of
/// these, so that roots close to 0 are reached fast; otherwise it is in the middle of the numbers.
Dyadic between(const Dyadic& a, const Dyadic& b) {
  const int high = magnitude(b);
  if (a.numerator == 0) return power_of_half(high > -1 ? 1 : -2 * high);
  const int low = magnitude(a);
  if (high - low > 1) return power_of_half(-(low + high) / 2);  // rounded up, so it is below b and above a
  const unsigned exponent = std::max(a.exponent, b.exponent);
  return {(a.numerator << (exponent - a.exponent)) + (b.numerator << (exponent - b.exponent)), exponent + 1};
}

/// A square-free polynomial with its Sturm sequence.
struct SturmSequence {
  IntegerPolynomial f;
  std::vector<IntegerPolynomial> sturm;

  /// The sequence of the polynomial that has the same roots, each of them simple.
  explicit SturmSequence(IntegerPolynomial polynomial)
      : f(std::move(polynomial)), sturm(remainder_sequence(f, f.derivative())) {
    const IntegerPolynomial& common = sturm.back();  // of f and its derivative
    if (common.degree() > 0) *this = SturmSequence(f.quotient(common));
  }
};

/// A place in (0, 1) that is no root, or an end, with the number of sign changes there.
struct Place {
  Dyadic t;
  int variations;

  Place(const SturmSequence& sequence, Dyadic place)
      : t(std::move(place)), variations(sign_variations(sequence.sturm, t)) {}
};

/// Adds the roots of f between two places.
void isolate(const SturmSequence& sequence, const Place& lo, const Place& hi, std::vector<SturmRoot>& roots) {
  const IntegerPolynomial& f = sequence.f;
  const int count = lo.variations - hi.variations;
  if (count == 0) return;
  if (count == 1) {
    roots.emplace_back(f, lo.t, hi.t);
    return;
  }
  const Dyadic division = between(lo.t, hi.t);
  if (f.sign_at(division) == 0) {
    roots.emplace_back(division);
    const SturmSequence rest(without_root(f, division));
    const Place middle(rest, division);
    isolate(rest, Place(rest, lo.t), middle, roots);
    isolate(rest, middle, Place(rest, hi.t), roots);
  } else {
    const Place middle(sequence, division);
    isolate(sequence, lo, middle, roots);
    isolate(sequence, middle, hi, roots);
  }
}

}  // namespace

SturmRoot::SturmRoot(IntegerPolynomial f, Dyadic lo, Dyadic hi)
    : f_(std::move(f)), lo_(std::move(lo)), hi_(std::move(hi)), sign_at_lo_(f_.sign_at(lo_)) {}

void SturmRoot::halve() {
  ++halvings_;
  Dyadic middle = between(lo_, hi_);
  const int sign = f_.sign_at(middle);
  is_dyadic_ = sign == 0;
  (is_dyadic_ || sign == sign_at_lo_ ? lo_ : hi_) = std::move(middle);
}

int SturmRoot::sign(const IntegerPolynomial& g) {
  if (g.is_zero()) return 0;
  constexpr int most_halvings = 24;  // interval arithmetic shows most signs by then
  for (;;) {
    if (is_dyadic_) return g.sign_at(lo_);
    if (const int sign = g.sign_on(lo_, hi_); sign != 0) return sign;
    if (halvings_ == most_halvings) return tarski_query(f_, g, lo_, hi_);
    constexpr int at_once = 6;
    for (int i = 0; i < at_once && !is_dyadic_; ++i) halve();
  }
}

bool SturmRoot::is_below(const Dyadic& number) const {
  if (is_dyadic_) return lo_ < number;
  if (!(lo_ < number)) return false;
  if (!(number < hi_)) return true;
  const int sign = f_.sign_at(number);
  return sign != 0 && sign != sign_at_lo_;
}

std::vector<SturmRoot> roots_in_unit_interval(const IntegerPolynomial& f) {
  std::vector<SturmRoot> roots;
  IntegerPolynomial rest = f;
  const Dyadic zero{0, 0};
  const Dyadic one{1, 0};
  for (const Dyadic& end : {zero, one}) {
    if (rest.sign_at(end) != 0) continue;
    roots.emplace_back(end);
    while (rest.sign_at(end) == 0) rest = without_root(rest, end);
  }
  const int most = rest.most_roots_inside();
  if (most == 1) roots.emplace_back(rest, zero, one);
  if (most > 1) {
    const SturmSequence sequence(rest);
    isolate(sequence, Place(sequence, zero), Place(sequence, one), roots);
  }
  return roots;
}

}  // namespace nearmiss::sturm
