// Finds the real roots of a polynomial in [0, 1].
#include <algorithm>
#include <bit>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "oracle/exact/root.hpp"

namespace nearmiss::exact {

namespace {

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

  /// Whether it is known to lie in an open interval, and that is within [lo, hi].
  [[nodiscard]] bool is_enclosed_in(const Number& lo, const Number& hi) const {
    return root.lo() < root.hi() && lo <= root.lo() && root.hi() <= hi;
  }
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
    const auto add_part = [&](const Number& lo, const Number& hi) {
      const bool keeps = extremum && extremum->is_enclosed_in(lo, hi);
      parts.push_back({lo, hi, !part.guess, keeps ? extremum : nullptr});
    };
    Number hi = part.hi;
    for (const Number& lo : at) {
      if (!(part.lo < lo && lo < hi)) continue;
      if (p->sign_at(lo) == 0) return {{}, lo};
      add_part(lo, hi);
      hi = lo;
    }
    add_part(part.lo, hi);
  }
  return isolated;
}

}  // namespace

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
