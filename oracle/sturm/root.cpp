#include "oracle/sturm/root.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace nearmiss::sturm {

namespace {

/// The common factor of f and g that has the highest degree.
IntegerPolynomial common_factor(const IntegerPolynomial& f, const IntegerPolynomial& g) {
  return remainder_sequence(f, g.degree() < f.degree() ? g : g.remainder(f)).back();
}

/// f divided by the factor of its simple root t.
IntegerPolynomial without_root(const IntegerPolynomial& f, const Dyadic& t) {
  return f.quotient(IntegerPolynomial({-t.numerator, Integer(1) << t.exponent}));
}

/// The integer e with 2^e <= x < 2^(e + 1), for x > 0.
int magnitude(const Dyadic& x) { return static_cast<int>(msb(x.numerator)) - static_cast<int>(x.exponent); }

Dyadic power_of_half(int exponent) { return {1, static_cast<unsigned>(exponent)}; }

/// The numerators of two numbers with a common denominator, 2^exponent.
struct SameDenominator {
  unsigned exponent;
  Integer lo, hi;

  SameDenominator(const Dyadic& a, const Dyadic& b)
      : exponent(std::max(a.exponent, b.exponent)),
        lo(a.numerator << (exponent - a.exponent)),
        hi(b.numerator << (exponent - b.exponent)) {}
};

/// A number between a and b, for 0 <= a < b <= 1. If their magnitudes are far apart, it is in the middle of
/// these, so that roots close to 0 are reached fast; otherwise it is in the middle of the numbers.
Dyadic between(const Dyadic& a, const Dyadic& b) {
  const int high = magnitude(b);
  if (a.numerator == 0) return power_of_half(high > -1 ? 1 : -2 * high);
  const int low = magnitude(a);
  if (high - low > 1) return power_of_half(-(low + high) / 2);  // rounded up, so it is below b and above a
  const SameDenominator ends(a, b);
  return {ends.lo + ends.hi, ends.exponent + 1};
}

/// lo + (hi - lo) i / 2^bits.
Dyadic border_of_piece(const Dyadic& lo, const Dyadic& hi, const Integer& i, unsigned bits) {
  const SameDenominator ends(lo, hi);
  return {(ends.lo << bits) + (ends.hi - ends.lo) * i, ends.exponent + bits};
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

/// A number that is 0, 1 or not a root, with the number of sign changes of the sequence there.
struct Place {
  Dyadic t;
  int variations;

  Place(const SturmSequence& sequence, Dyadic place)
      : t(std::move(place)), variations(sign_variations(sequence.sturm, t)) {}
};

int roots_between(const Place& lo, const Place& hi) { return lo.variations - hi.variations; }

/// Guesses which border of 2^bits pieces of an interval is nearest to a cluster of roots in it; -1 if the
/// guess is outside. It is a step of Schröder's method, Newton's for f / f', from the lower end.
Integer border_near_cluster(const IntegerPolynomial& f, const Dyadic& lo, const Dyadic& hi, unsigned bits) {
  const SameDenominator ends(lo, hi);
  const IntegerPolynomial slope = f.derivative();
  const Integer f0 = f.scaled_value(lo);
  const Integer f1 = slope.scaled_value(lo);
  const Integer f2 = slope.derivative().scaled_value(lo);
  // The step is this fraction, divided by 2^(exponent of lo).
  Integer numerator = -f0 * f1;
  Integer denominator = f1 * f1 - f0 * f2;
  if (denominator == 0) return -1;
  numerator <<= bits + ends.exponent - lo.exponent;
  denominator *= ends.hi - ends.lo;
  if (denominator < 0) {
    numerator = -numerator;
    denominator = -denominator;
  }
  if (numerator < 0) return -1;
  const Integer border = (2 * numerator + denominator) / (2 * denominator);
  return border > Integer(1) << bits ? -1 : border;
}

/// A part of an interval, around a guess, that certainly has all its roots; nothing if the guess gives none.
std::optional<std::pair<Place, Place>> narrowed(const SturmSequence& sequence, const Place& lo,
                                                const Place& hi, unsigned bits) {
  const IntegerPolynomial& f = sequence.f;
  const int count = roots_between(lo, hi);
  const Integer border = border_near_cluster(f, lo.t, hi.t, bits);
  if (border < 0) return std::nullopt;
  std::pair<Place, Place> part(lo, hi);
  const auto move_to = [&](Place& end, const Integer& i) {
    end = Place(sequence, border_of_piece(lo.t, hi.t, i, bits));
    return f.sign_at(end.t) != 0;
  };
  if (border > 1 && !move_to(part.first, border - 1)) return std::nullopt;
  if (border + 1 < Integer(1) << bits && !move_to(part.second, border + 1)) return std::nullopt;
  if (roots_between(part.first, part.second) != count) return std::nullopt;
  return part;
}

/// Adds the roots of f between two places.
void isolate(const SturmSequence& sequence, const Place& lo, const Place& hi, Fineness fineness,
             std::vector<SturmRoot>& roots) {
  const IntegerPolynomial& f = sequence.f;
  const int count = roots_between(lo, hi);
  if (count == 0) return;
  if (count == 1) {
    roots.emplace_back(f, lo.t, hi.t);
    return;
  }
  const auto part = narrowed(sequence, lo, hi, fineness.bits());
  fineness.after(part.has_value());
  if (part) {
    isolate(sequence, part->first, part->second, fineness, roots);
    return;
  }
  const Dyadic division = between(lo.t, hi.t);
  if (f.sign_at(division) == 0) {
    roots.emplace_back(division);
    const SturmSequence rest(without_root(f, division));
    const Place middle(rest, division);
    isolate(rest, Place(rest, lo.t), middle, fineness, roots);
    isolate(rest, middle, Place(rest, hi.t), fineness, roots);
  } else {
    const Place middle(sequence, division);
    isolate(sequence, lo, middle, fineness, roots);
    isolate(sequence, middle, hi, fineness, roots);
  }
}

}  // namespace

SturmRoot::SturmRoot(IntegerPolynomial f, Dyadic lo, Dyadic hi)
    : lo_{std::move(lo), 0}, hi_{std::move(hi), 0} {
  set_polynomial(std::move(f));
}

/// Cuts the interval at a number in it.
void SturmRoot::cut(Dyadic at) {
  Integer value = f_.scaled_value(at);
  is_dyadic_ = value == 0;
  End& end = is_dyadic_ || value.sign() == lo_.value.sign() ? lo_ : hi_;
  end = {std::move(at), std::move(value)};
}

/// The border between pieces that is nearest to the zero of the chord.
Integer SturmRoot::border_by_chord() const {
  const auto degree = static_cast<unsigned>(f_.degree());
  const SameDenominator values({abs(lo_.value), degree * lo_.t.exponent},
                               {abs(hi_.value), degree * hi_.t.exponent});
  const Integer rise = values.lo + values.hi;
  return ((values.lo << (fineness_.bits() + 1)) + rise) / (2 * rise);
}

/// Shrinks the interval to the two pieces beside a border if the root is in them. Returns whether it is.
bool SturmRoot::shrink_to(const Integer& border) {
  const unsigned bits = fineness_.bits();
  const Dyadic below = border_of_piece(lo_.t, hi_.t, border - 1, bits);
  const Dyadic above = border_of_piece(lo_.t, hi_.t, border + 1, bits);
  for (const Dyadic& at : {below, above})
    if (!is_dyadic_ && lo_.t < at && at < hi_.t) cut(at);
  return is_dyadic_ || (!(lo_.t < below) && !(above < hi_.t));
}

void SturmRoot::refine() {
  // Complex roots near this one bend the curve, so the chord says little; a guess for a cluster says more.
  constexpr int many = 8;
  ++refinements_;
  bool good_guess = shrink_to(border_by_chord());
  if (!good_guess && refinements_ > many) {
    const Integer border = border_near_cluster(f_, lo_.t, hi_.t, fineness_.bits());
    good_guess = border >= 0 && shrink_to(border);
  }
  if (is_dyadic_) return;
  fineness_.after(good_guess);
  if (!good_guess) cut(between(lo_.t, hi_.t));
}

void SturmRoot::set_polynomial(IntegerPolynomial f) {
  f_ = std::move(f);
  lo_.value = f_.scaled_value(lo_.t);
  hi_.value = f_.scaled_value(hi_.t);
}

bool SturmRoot::is_common_root(const IntegerPolynomial& g) {
  IntegerPolynomial common = common_factor(f_, g);
  if (common.degree() == 0) return false;
  // Between the ends, a factor of f has no root or only this simple one. It is not zero at the ends.
  const bool is_root = common.sign_at(lo_.t) != common.sign_at(hi_.t);
  set_polynomial(is_root ? std::move(common) : f_.quotient(common));
  return is_root;
}

int SturmRoot::sign(const IntegerPolynomial& g) {
  if (g.is_zero()) return 0;
  constexpr int patience = 5;  // interval arithmetic shows most signs after this many refinements
  for (bool may_be_zero = true;;) {
    if (is_dyadic_) return g.sign_at(lo_.t);
    if (const int sign = g.sign_on(lo_.t, hi_.t); sign != 0) return sign;
    if (may_be_zero && refinements_ >= patience) {
      if (!are_surely_coprime(f_, g) && is_common_root(g)) return 0;
      may_be_zero = false;
    }
    refine();
  }
}

bool SturmRoot::is_below(const Dyadic& number) const {
  if (is_dyadic_) return lo_.t < number;
  if (!(lo_.t < number)) return false;
  if (!(number < hi_.t)) return true;
  const int sign = f_.sign_at(number);
  return sign != 0 && sign != lo_.value.sign();
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
    isolate(sequence, Place(sequence, zero), Place(sequence, one), {}, roots);
  }
  return roots;
}

}  // namespace nearmiss::sturm
