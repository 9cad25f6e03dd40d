#include "tests/proofs/oracle_theorem.hpp"

#include <fmt/format.h>

#include <set>

#include "tests/proofs/factors.hpp"
#include "tests/proofs/numbers.hpp"

namespace nearmiss::proofs {

namespace {

int degree(const Monomial& monomial) {
  int sum = 0;
  for (const auto& [name, power] : monomial) sum += power;
  return sum;
}

/// Replaces each leaf of a term by leaf + error, expands the product, and adds the terms that contain an
/// error to `all`.
void add_leaf_errors(const Term& term, const std::vector<std::string>& leaves, Expansion& all) {
  for (std::size_t chosen = 1; chosen < (std::size_t{1} << leaves.size()); ++chosen) {
    Term missed{term.coefficient, term.monomial, 0, 0};
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      if ((chosen >> i & 1) == 0) continue;
      missed.monomial.erase(leaves[i]);
      ++missed.monomial[error_of(leaves[i])];
    }
    all.push_back(std::move(missed));
  }
}

std::vector<std::string> leaves_of(const Term& term) {
  std::vector<std::string> leaves;
  for (const auto& [name, power] : term.monomial)
    if (is_component(name))
      // Each leaf occurs only once in a term, because the leaves of a term belong to different vectors.
      leaves.push_back(name);
  return leaves;
}

Expansion without_underflow(const Expansion& terms) {
  Expansion some;
  for (const Term& term : terms)
    if (term.underflows == 0) some.push_back(term);
  return some;
}
Expansion with_underflow(const Expansion& terms) {
  Expansion some;
  for (const Term& term : terms)
    if (term.underflows > 0) some.push_back(term);
  return some;
}

BoundTerm share(const BoundTerms& shares, const Monomial& monomial) {
  const auto found = shares.find(monomial);
  return found == shares.end() ? BoundTerm{0, 0} : found->second;
}

}  // namespace

Needs needs_of(const Bounded& bounded, const ValuePrecision& precision) {
  const Expansion value = expand(bounded.value, precision.roundings);
  const Expansion error = expand(bounded.error);
  Expansion leaves;
  if (bounded.leaves == Leaves::given_errors)
    for (const Term& term : without_underflow(value)) add_leaf_errors(term, leaves_of(term), leaves);
  const auto bound_of = [&](const Expansion& terms) { return bound(terms, magnitude_of, bounded.times); };
  return {bound_of(without_underflow(value)), bound_of(leaves), bound_of(with_underflow(value)),
          bound_of(without_underflow(error)), bound_of(with_underflow(error))};
}

std::set<std::string> scripts_of(const Bounded& bounded, const ValuePrecision& precision) {
  const Needs needs = needs_of(bounded, precision);
  std::set<Monomial> monomials;
  for (const BoundTerms* shares : {&needs.values, &needs.leaves, &needs.underflows, &needs.bound_underflows})
    for (const auto& [monomial, each] : *shares) monomials.insert(monomial);
  std::set<std::string> scripts;
  for (const Monomial& monomial : monomials) {
    Factors factors;
    const auto times = [&](const BoundTerm& s, double size) {
      return fmt::format("{} * {}", script_text(s.coefficient), factors.product(s.roundings, size));
    };
    // The unit H is written as a product, because half of the smallest double is not a double.
    const auto underflow = [&](const BoundTerm& s, double size, double of_smallest) {
      return fmt::format("{} * {:a} * {:a}", times(s, size), of_smallest, certified::smallest);
    };
    const BoundTerm value = share(needs.values, monomial);
    const int leaves = bounded.leaves == Leaves::rounded_once ? degree(monomial) : 0;
    const std::string roundings = fmt::format("{} * ({} - {})", script_text(value.coefficient),
                                              factors.product(value.roundings, precision.roundoff),
                                              factors.product(leaves, precision.roundoff));
    // The magnitudes in a script are those of the upper halves of double words. The magnitude of a double
    // word is at most (1 + u) times the magnitude of its upper half.
    const std::string halves = factors.product(precision.is_double_word ? degree(monomial) : 0, u);
    const std::string others = fmt::format(
        "{} + {} + {}", times(share(needs.leaves, monomial), 0),
        underflow(share(needs.underflows, monomial), precision.roundoff, precision.underflow),
        underflow(share(needs.bound_underflows, monomial), u, certified::product_underflow<double>));
    const std::string offered = times(share(needs.bound, monomial), u);
    const auto goal = [&](const char* sign) {
      return fmt::format("({}{} + {}) * {} - {} <= 0", sign, roundings, others, halves, offered);
    };
    scripts.insert(factors.script(goal("") + " /\\ " + goal("-")));
  }
  return scripts;
}

}  // namespace nearmiss::proofs
