#include "oracle/rational_polynomial.hpp"

#include <algorithm>

namespace nearmiss::sturm {

Polynomial::Polynomial(std::vector<Rational> coefficients) : c_(std::move(coefficients)) {
  while (!c_.empty() && c_.back() == 0) c_.pop_back();
}

Rational Polynomial::operator()(const Rational& t) const {
  Rational value = 0;
  for (auto c = c_.rbegin(); c != c_.rend(); ++c) value = value * t + *c;
  return value;
}

Polynomial Polynomial::derivative() const {
  std::vector<Rational> d;
  for (std::size_t i = 1; i < c_.size(); ++i) d.push_back(c_[i] * i);
  return Polynomial(std::move(d));
}

Polynomial Polynomial::operator+(const Polynomial& other) const {
  std::vector<Rational> sum(std::max(c_.size(), other.c_.size()));
  for (std::size_t i = 0; i < c_.size(); ++i) sum[i] += c_[i];
  for (std::size_t i = 0; i < other.c_.size(); ++i) sum[i] += other.c_[i];
  return Polynomial(std::move(sum));
}

Polynomial Polynomial::operator-() const {
  std::vector<Rational> negative;
  for (const Rational& c : c_) negative.push_back(-c);
  return Polynomial(std::move(negative));
}

Polynomial Polynomial::operator-(const Polynomial& other) const { return *this + -other; }

Polynomial Polynomial::operator*(const Polynomial& other) const {
  if (is_zero() || other.is_zero()) return {};
  std::vector<Rational> product(c_.size() + other.c_.size() - 1);
  for (std::size_t i = 0; i < c_.size(); ++i)
    for (std::size_t j = 0; j < other.c_.size(); ++j) product[i + j] += c_[i] * other.c_[j];
  return Polynomial(std::move(product));
}

Polynomial::Division Polynomial::divided_by(const Polynomial& other) const {
  std::vector<Rational> rest = c_;
  const std::size_t n = other.c_.size();
  std::vector<Rational> quotient(rest.size() >= n ? rest.size() - n + 1 : 0);
  for (std::size_t i = quotient.size(); i-- > 0;) {
    quotient[i] = rest[i + n - 1] / other.c_.back();
    for (std::size_t j = 0; j < n; ++j) rest[i + j] -= quotient[i] * other.c_[j];
  }
  return {Polynomial(std::move(quotient)), Polynomial(std::move(rest))};
}

namespace {

int sign_of(const Rational& x) { return x.sign(); }

/// The signed remainder sequence of f and g.
std::vector<Polynomial> remainder_sequence(const Polynomial& f, const Polynomial& g) {
  std::vector<Polynomial> sequence{f, g};
  while (!sequence.back().is_zero())
    sequence.push_back(-sequence[sequence.size() - 2].divided_by(sequence.back()).remainder);
  sequence.pop_back();
  return sequence;
}

int sign_variations(const std::vector<Polynomial>& sequence, const Rational& t) {
  int variations = 0;
  int last = 0;
  for (const Polynomial& p : sequence) {
    const int sign = sign_of(p(t));
    if (sign == 0) continue;
    variations += last != 0 && sign != last ? 1 : 0;
    last = sign;
  }
  return variations;
}

/// Tarski's query: the sum over the roots of f in (lo, hi) of the sign of g there; f is square-free and not
/// zero at the ends.
int tarski_query(const Polynomial& f, const Polynomial& g, const Rational& lo, const Rational& hi) {
  const auto sequence = remainder_sequence(f, f.derivative() * g);
  return sign_variations(sequence, lo) - sign_variations(sequence, hi);
}

Polynomial square_free(const Polynomial& f) {
  if (f.degree() < 1) return f;
  return f.divided_by(remainder_sequence(f, f.derivative()).back()).quotient;
}

/// f without its simple root at t.
Polynomial without_root(const Polynomial& f, const Rational& t) {
  return f.divided_by(Polynomial({-t, 1})).quotient;
}

/// Adds the roots of a square-free f in (lo, hi), where it is not zero at the ends.
void isolate(const Polynomial& f, const Rational& lo, const Rational& hi, std::vector<Root>& roots) {
  if (f.degree() < 1) return;
  const int count = tarski_query(f, Polynomial({1}), lo, hi);
  if (count == 0) return;
  if (count == 1) {
    roots.emplace_back(f, lo, hi);
    return;
  }
  const Rational middle = (lo + hi) / 2;
  Polynomial rest = f;
  if (f(middle) == 0) {
    roots.emplace_back(middle);
    rest = without_root(f, middle);
  }
  isolate(rest, lo, middle, roots);
  isolate(rest, middle, hi, roots);
}

}  // namespace

int Root::sign(const Polynomial& g) const {
  if (is_rational_) return sign_of(g(value_));
  if (g.is_zero()) return 0;
  return tarski_query(f_, g, lo_, hi_);
}

std::vector<Root> roots_in_unit_interval(const Polynomial& f) {
  std::vector<Root> roots;
  Polynomial rest = square_free(f);
  for (const int end : {0, 1}) {
    if (rest(end) != 0) continue;
    roots.emplace_back(Rational(end));
    rest = without_root(rest, end);
  }
  isolate(rest, 0, 1, roots);
  return roots;
}

}  // namespace nearmiss::sturm
