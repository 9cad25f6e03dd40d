#include "oracle/polynomial.hpp"

#include <algorithm>
#include <cstddef>

namespace nearmiss::exact {

int sign(const Number& x) { return static_cast<int>(CGAL::sign(x)); }

Polynomial::Polynomial(std::vector<Number> coefficients) : a_(std::move(coefficients)) {
  while (!a_.empty() && CGAL::is_zero(a_.back())) a_.pop_back();
}

Number Polynomial::operator()(const Number& t) const {
  Number value = 0;
  for (std::size_t i = a_.size(); i > 0; --i) value = value * t + a_[i - 1];
  return value;
}

Polynomial Polynomial::derivative() const {
  std::vector<Number> d;
  for (std::size_t i = 1; i < a_.size(); ++i) d.push_back(a_[i] * Number(static_cast<int>(i)));
  return Polynomial(std::move(d));
}

Polynomial operator+(const Polynomial& p, const Polynomial& q) {
  std::vector<Number> sum = p.a_;
  sum.resize(std::max(p.a_.size(), q.a_.size()));
  for (std::size_t i = 0; i < q.a_.size(); ++i) sum[i] = sum[i] + q.a_[i];
  return Polynomial(std::move(sum));
}

Polynomial operator-(const Polynomial& p, const Polynomial& q) {
  std::vector<Number> difference = p.a_;
  difference.resize(std::max(p.a_.size(), q.a_.size()));
  for (std::size_t i = 0; i < q.a_.size(); ++i) difference[i] = difference[i] - q.a_[i];
  return Polynomial(std::move(difference));
}

Polynomial operator*(const Polynomial& p, const Polynomial& q) {
  if (p.is_zero() || q.is_zero()) return {};
  std::vector<Number> product(p.a_.size() + q.a_.size() - 1);
  for (std::size_t i = 0; i < p.a_.size(); ++i)
    for (std::size_t j = 0; j < q.a_.size(); ++j) product[i + j] = product[i + j] + p.a_[i] * q.a_[j];
  return Polynomial(std::move(product));
}

Division divide(const Polynomial& p, const Polynomial& q) {
  Division division{{}, p};
  auto& [quotient, remainder] = division;
  const int side = sign(q.leading());
  const Polynomial factor({side > 0 ? q.leading() : -q.leading()});
  while (remainder.degree() >= q.degree()) {
    std::vector<Number> term(static_cast<std::size_t>(remainder.degree() - q.degree()) + 1);
    term.back() = side > 0 ? remainder.leading() : -remainder.leading();
    const Polynomial step(std::move(term));
    quotient = factor * quotient + step;
    remainder = factor * remainder - step * q;
  }
  return division;
}

Polynomial greatest_common_divisor(Polynomial p, Polynomial q) {
  while (!q.is_zero()) p = std::exchange(q, divide(p, q).remainder);
  return p;
}

Polynomial square_free(const Polynomial& p) {
  if (p.degree() < 2) return p;
  const Polynomial common = greatest_common_divisor(p, p.derivative());
  return common.degree() < 1 ? p : divide(p, common).quotient;
}

int sign_changes(const std::vector<Number>& numbers) {
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
