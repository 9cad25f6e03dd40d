#include "tests/proofs/expansion.hpp"

#include <cmath>
#include <optional>
#include <stdexcept>

namespace nearmiss::proofs {

namespace {

Expansion constant(double value) {
  if (value == 0) return {};
  return {{Rational(value), {}, 0, 0}};
}

bool is_power_of_two(double x) {
  int exponent = 0;
  return std::abs(std::frexp(x, &exponent)) == 0.5;
}

Monomial product(Monomial a, const Monomial& b) {
  for (const auto& [name, power] : b) a[name] += power;
  return a;
}

Expansion rounded(Expansion terms, int roundings) {
  for (Term& term : terms) term.roundings += roundings;
  return terms;
}

Expansion with_underflow(Expansion terms) {
  terms.push_back({1, {}, 0, 1});
  return terms;
}

/// Expands the result of an instruction of the program. Expands the results of the instruction's operands
/// first.
class Expander {
 public:
  Expander(const Program& program, const Roundings& arithmetic)
      : program_(program), arithmetic_(arithmetic) {}

  Expansion of(int index) {
    const Instruction& one = program_[index];
    switch (one.operation) {
      case Operation::input:
        return {{1, {{one.name, 1}}, 0, 0}};
      case Operation::constant:
        return constant(one.constant);
      case Operation::negate:
        return negated(of(one.left));
      case Operation::add:
        return sum(of(one.left), of(one.right));
      case Operation::subtract:
        return is_complement(one) ? complement_of(one) : sum(of(one.left), negated(of(one.right)));
      case Operation::multiply:
        return product_of(one);
      case Operation::divide:
        return quotient_of(one);
      case Operation::absolute:
        return magnitude_of_difference(one);
      case Operation::largest:
        return largest_magnitude(one);
      default:
        throw std::logic_error("found an operation that has no expansion: a minimum or a root");
    }
  }

 private:
  [[nodiscard]] const Instruction& at(int index) const { return program_[index]; }
  [[nodiscard]] bool is_constant(int index) const { return at(index).operation == Operation::constant; }

  static Expansion negated(Expansion terms) {
    for (Term& term : terms) term.coefficient = -term.coefficient;
    return terms;
  }

  static Expansion sum(Expansion a, const Expansion& b) {
    const bool is_exact = a.empty() || b.empty();
    a.insert(a.end(), b.begin(), b.end());
    return is_exact ? a : rounded(std::move(a), 1);
  }

  /// 1 - t.
  [[nodiscard]] bool is_complement(const Instruction& one) const {
    return is_constant(one.left) && at(one.left).constant == 1 && at(one.right).operation == Operation::input;
  }
  [[nodiscard]] Expansion complement_of(const Instruction& one) const {
    return {{1, {{complement(at(one.right).name), 1}}, 1, 0}};
  }

  Expansion product_of(const Instruction& one) {
    const Expansion a = of(one.left);
    const Expansion b = of(one.right);
    Expansion terms;
    for (const Term& x : a)
      for (const Term& y : b)
        terms.push_back({x.coefficient * y.coefficient, product(x.monomial, y.monomial),
                         x.roundings + y.roundings, x.underflows + y.underflows});
    for (const int side : {one.left, one.right}) {
      if (!is_constant(side) || !is_power_of_two(at(side).constant)) continue;
      return std::abs(at(side).constant) >= 1 ? terms : with_underflow(std::move(terms));
    }
    if (terms.empty()) return terms;  // a product with 0
    return with_underflow(rounded(std::move(terms), 1));
  }

  /// The expansion of |x - y|, where x and y are inputs.
  [[nodiscard]] Expansion magnitude_of_difference(const Instruction& one) const {
    const Instruction& inside = at(one.left);
    const bool is_plain = inside.operation == Operation::subtract &&
                          at(inside.left).operation == Operation::input &&
                          at(inside.right).operation == Operation::input;
    if (!is_plain) throw std::logic_error("found a magnitude of something other than a difference of inputs");
    return {{1, {{steepest, 1}}, 1, 0}};
  }
  /// The expansion of the larger of two magnitudes |x - y| of differences. Both magnitudes have the same
  /// monomial, so the expansion of the magnitude with more roundings serves for both.
  Expansion largest_magnitude(const Instruction& one) {
    const Expansion a = of(one.left);
    const Expansion b = of(one.right);
    if (a.size() != 1 || b.size() != 1 || a[0].monomial != b[0].monomial)
      throw std::logic_error("found a maximum of something other than magnitudes of differences");
    return a[0].roundings >= b[0].roundings ? a : b;
  }

  Expansion quotient_of(const Instruction& one) {
    if (!is_constant(one.right)) throw std::logic_error("found a quotient by something that is not constant");
    Expansion terms = of(one.left);
    for (Term& term : terms) term.coefficient /= Rational(at(one.right).constant);
    return with_underflow(rounded(std::move(terms), arithmetic_.quotient));
  }

  const Program& program_;
  Roundings arithmetic_;
};

// --- bounds over times ------------------------------------------------------------------------------------

/// A polynomial in several times. The key of a term lists the powers of t and 1 - t for each time t; the
/// value is the term's coefficient.
using InTimes = std::map<std::vector<int>, Rational>;

int degree_in(const InTimes& polynomial, std::size_t time) {
  int degree = 0;
  for (const auto& [powers, c] : polynomial)
    degree = std::max(degree, powers[2 * time] + powers[2 * time + 1]);
  return degree;
}

/// Multiplies terms by (t + (1 - t)), where t is the given time, until every term has the given degree in t
/// and 1 - t.
InTimes elevated(const InTimes& polynomial, std::size_t time, int degree) {
  InTimes all;
  for (const auto& [powers, c] : polynomial) {
    const int missing = degree - powers[2 * time] - powers[2 * time + 1];
    Rational binomial = 1;
    for (int i = 0; i <= missing; ++i) {
      auto higher = powers;
      higher[2 * time] += i;
      higher[2 * time + 1] += missing - i;
      all[higher] += c * binomial;
      binomial = binomial * (missing - i) / (i + 1);
    }
  }
  return all;
}

Rational choose(int n, int k) {
  Rational binomial = 1;
  for (int i = 0; i < k; ++i) binomial = binomial * (n - i) / (i + 1);
  return binomial;
}

Rational largest_bernstein_coefficient(InTimes polynomial, std::size_t times) {
  for (std::size_t time = 0; time < times; ++time)
    polynomial = elevated(polynomial, time, degree_in(polynomial, time));
  Rational largest = 0;
  for (const auto& [powers, c] : polynomial) {
    Rational coefficient = c;
    for (std::size_t time = 0; time < times; ++time)
      coefficient /= choose(powers[2 * time] + powers[2 * time + 1], powers[2 * time]);
    largest = std::max(largest, coefficient);
  }
  return largest;
}

}  // namespace

std::string complement(const std::string& t) { return "1-" + t; }

Expansion expand(const Traced& expression, const Roundings& arithmetic) {
  Program program;
  const int result = program.add(expression);
  return expand(program, result, arithmetic);
}

Expansion expand(const Program& program, int result, const Roundings& arithmetic) {
  return Expander(program, arithmetic).of(result);
}

BoundTerms bound(const Expansion& terms, const MagnitudeOf& magnitude_of,
                 const std::vector<std::string>& times) {
  std::map<Monomial, InTimes> by_monomial;
  BoundTerms shares;
  for (const Term& term : terms) {
    Monomial magnitudes;
    std::vector<int> powers(2 * times.size());
    for (const auto& [name, power] : term.monomial) {
      bool is_time = false;
      for (std::size_t i = 0; i < times.size(); ++i) {
        if (name == times[i]) powers[2 * i] += power;
        if (name == complement(times[i])) powers[2 * i + 1] += power;
        is_time |= name == times[i] || name == complement(times[i]);
      }
      if (!is_time) magnitudes[magnitude_of(name)] += power;
    }
    by_monomial[magnitudes][powers] += abs(term.coefficient);
    BoundTerm& share = shares[magnitudes];
    share.roundings = std::max(share.roundings, term.roundings);
  }
  for (const auto& [monomial, polynomial] : by_monomial)
    shares[monomial].coefficient = largest_bernstein_coefficient(polynomial, times.size());
  return shares;
}

}  // namespace nearmiss::proofs
