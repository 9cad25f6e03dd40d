#include "oracle/exact/polynomial.hpp"

#include <CGAL/Gmpq.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "oracle/exact/residues.hpp"

namespace nearmiss::exact {

int sign(const Number& x) { return static_cast<int>(CGAL::sign(x)); }

Polynomial::Polynomial(Numbers&& coefficients) : a_(std::move(coefficients)) {
  while (!a_.empty() && CGAL::is_zero(a_.back())) a_.pop_back();
}

Number Polynomial::operator()(const Number& t) const {
  if (is_zero()) return 0;
  Number value = leading();
  for (std::size_t i = a_.size() - 1; i > 0; --i) value = value * t + a_[i - 1];
  return value;
}

Polynomial Polynomial::derivative() const {
  Numbers d;
  for (std::size_t i = 1; i < a_.size(); ++i) d.push_back(a_[i] * Number(static_cast<int>(i)));
  return Polynomial(std::move(d));
}

namespace {

/// Combines the coefficients of two polynomials one by one. If one polynomial has fewer coefficients than the
/// other, its missing coefficients count as 0.
template <class Combine>
Polynomial by_coefficients(const Polynomial& p, const Polynomial& q, const Combine& combine) {
  static const Number zero = 0;
  const auto& a = p.coefficients();
  const auto& b = q.coefficients();
  Numbers result;
  result.reserve(std::max(a.size(), b.size()));
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i)
    result.push_back(combine(i < a.size() ? a[i] : zero, i < b.size() ? b[i] : zero));
  return Polynomial(std::move(result));
}

}  // namespace

Polynomial operator+(const Polynomial& p, const Polynomial& q) {
  return by_coefficients(p, q, [](const Number& x, const Number& y) { return x + y; });
}

Polynomial operator-(const Polynomial& p, const Polynomial& q) {
  return by_coefficients(p, q, [](const Number& x, const Number& y) { return x - y; });
}

Polynomial operator*(const Polynomial& p, const Polynomial& q) {
  if (p.is_zero() || q.is_zero()) return {};
  const std::size_t size = p.a_.size() + q.a_.size() - 1;
  Numbers product;
  product.reserve(size);
  for (std::size_t k = 0; k < size; ++k) {
    const std::size_t first = k < q.a_.size() ? 0 : k + 1 - q.a_.size();
    Number sum = p.a_[first] * q.a_[k - first];
    for (std::size_t i = first + 1; i < p.a_.size() && i <= k; ++i) sum = sum + p.a_[i] * q.a_[k - i];
    product.push_back(std::move(sum));
  }
  return Polynomial(std::move(product));
}

bool are_proportional(const Polynomial& p, const Polynomial& q) {
  if (p.degree() != q.degree()) return false;
  const auto& a = p.coefficients();
  const auto& b = q.coefficients();
  for (std::size_t i = 0; i + 1 < a.size(); ++i)
    if (a[i] * q.leading() != b[i] * p.leading()) return false;
  return true;
}

namespace {

/// The remainder of c p divided by q. The factor c is a power of |l|, where l is the leading coefficient of
/// q. The exponent is 1 plus the difference of the degrees of p and q.
Polynomial pseudo_remainder(const Polynomial& p, const Polynomial& q) {
  const int side = sign(q.leading());
  const Number lead = side > 0 ? q.leading() : -q.leading();
  Numbers rest = p.coefficients();
  const Numbers& b = q.coefficients();
  while (rest.size() >= b.size()) {
    const Number top = side > 0 ? rest.back() : -rest.back();
    rest.pop_back();
    const std::size_t shift = rest.size() + 1 - b.size();
    for (std::size_t i = 0; i < rest.size(); ++i) {
      rest[i] = lead * rest[i];
      if (i >= shift) rest[i] = rest[i] - top * b[i - shift];
    }
  }
  return Polynomial(std::move(rest));
}

}  // namespace

Division divide(const Polynomial& p, const Polynomial& q) {
  Division division{{}, p};
  auto& [quotient, remainder] = division;
  const int side = sign(q.leading());
  const Polynomial factor({side > 0 ? q.leading() : -q.leading()});
  while (remainder.degree() >= q.degree()) {
    Numbers term(static_cast<std::size_t>(remainder.degree() - q.degree()) + 1);
    term.back() = side > 0 ? remainder.leading() : -remainder.leading();
    const Polynomial step(std::move(term));
    quotient = factor * quotient + step;
    remainder = factor * remainder - step * q;
  }
  return division;
}

std::vector<Polynomial> remainders(const Polynomial& p, const Polynomial& q) {
  // The polynomials after p and q are subresultants, up to their signs. Their coefficients have known common
  // factors, which are divided out. So the coefficients stay as short as determinants of the coefficients of
  // p and q.
  std::vector<Polynomial> sequence{p, q};
  Number g = 1;
  Number h = 1;
  for (;;) {
    const Polynomial& a = sequence[sequence.size() - 2];
    const Polynomial& b = sequence.back();
    const int steps = a.degree() - b.degree();
    const Number lead = sign(b.leading()) > 0 ? b.leading() : -b.leading();
    const Polynomial remainder = pseudo_remainder(a, b);
    if (remainder.is_zero()) return sequence;
    Number factor = -g;
    for (int i = 0; i < steps; ++i) factor = factor * h;
    Numbers next = remainder.coefficients();
    for (Number& c : next) c = c / factor;
    g = lead;
    Number power = 1;
    for (int i = 0; i < steps; ++i) power = power * g;
    for (int i = 1; i < steps; ++i) power = power / h;
    if (steps > 0) h = power;
    sequence.emplace_back(std::move(next));
    if (sequence.back().degree() == 0) return sequence;
  }
}

Polynomial greatest_common_divisor(const Polynomial& p, const Polynomial& q) {
  if (p.is_zero()) return q;
  if (q.is_zero()) return p;
  return (p.degree() < q.degree() ? remainders(q, p) : remainders(p, q)).back();
}

Polynomial primitive(const Polynomial& p) {
  CGAL::Gmpz content = 0;
  for (const Number& c : p.coefficients()) content = CGAL::gcd(content, CGAL::Gmpq(c).numerator());
  Numbers coefficients = p.coefficients();
  for (Number& c : coefficients) c = c / Number(content);
  return Polynomial(std::move(coefficients));
}

namespace {

/// p divided by `factor`, a linear factor of p whose coefficients have no common divisor.
Polynomial without_factor(const Polynomial& p, const Polynomial& factor) {
  Numbers quotient(p.coefficients().begin() + 1, p.coefficients().end());
  quotient.back() = quotient.back() / factor.leading();
  for (std::size_t i = quotient.size() - 1; i > 0; --i)
    quotient[i - 1] = (quotient[i - 1] - factor.coefficients()[0] * quotient[i]) / factor.leading();
  return Polynomial(std::move(quotient));
}

}  // namespace

Polynomial square_free(const Polynomial& p) {
  const Polynomial slope = p.derivative();
  if (are_coprime_by_residues(p, slope)) return p;
  if (const auto factor = only_double_factor(p)) return without_factor(p, *factor);
  const Polynomial common = greatest_common_divisor(p, slope);
  return common.degree() < 1 ? p : primitive(divide(p, primitive(common)).quotient);
}

int sign_changes(const Numbers& numbers) {
  int changes = 0;
  int last = 0;
  for (const Number& c : numbers) {
    const int s = sign(c);
    if (s != 0 && last != 0 && s != last) ++changes;
    if (s != 0) last = s;
  }
  return changes;
}

}  // namespace nearmiss::exact
