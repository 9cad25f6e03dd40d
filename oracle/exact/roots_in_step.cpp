// Finds the real roots of a polynomial in [0, 1].
#include <algorithm>
#include <memory>
#include <optional>
#include <tuple>
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

/// A part of the step, and how it is cut next.
struct Part {
  Number lo, hi;
  OnInterval on;
  bool at_extremum = true;  ///< if not, it is cut in the middle
  unsigned bits = 44;       ///< see shrink()

  Part(const Polynomial& p, const Number& from, const Number& to) : lo(from), hi(to), on(p, from, to) {}

  [[nodiscard]] Number at(const Number& fraction) const { return lo + fraction * (hi - lo); }

  /// Looks for clusters of roots. Shrinks the part to the neighbourhood of a cluster, if all changes of sign are
  /// in this neighbourhood; then there is no root elsewhere. Returns where to cut to separate clusters, the
  /// upper cut first; nothing if it finds no such place.
  Numbers shrink(const Polynomial& p) {
    constexpr unsigned least_bits = 11;
    for (bool shrunk = false;; shrunk = true) {
      if (const auto near_end = on.roots_near_end()) {
        const Number middle = at(near_end->middle);
        std::tie(lo, hi) = std::pair(at(near_end->lower), at(near_end->upper));
        return {middle};
      }
      // Parts shrink quadratically towards a multiple of 2^-bits, until it is no farther from the cluster's roots
      // than they are from each other.
      const auto cluster = on.guess_cluster(bits);
      if (!cluster) break;
      const Number unit = power_of_half(bits);
      const Number below = std::max(lo, at(*cluster - unit));
      const Number above = std::min(hi, at(*cluster + unit));
      OnInterval near_cluster(p, below, above);
      if (near_cluster.changes() != on.changes()) {
        if (!shrunk) break;
        bits = least_bits;
        return {above, below};
      }
      lo = below;
      hi = above;
      on = std::move(near_cluster);
      bits *= 2;
    }
    bits = std::max(least_bits, bits / 2);
    return {};
  }
};

/// Cuts the interval until every part has no root or one simple root. It cuts alternately near an extremum
/// and in the middle; there is an extremum between two close roots. If a few cuts do not help, it gives up
/// unless the polynomial is known to have no multiple roots; for such a polynomial, it looks for clusters of
/// roots between the cuts.
Isolated isolate(const std::shared_ptr<const Polynomial>& p, bool is_simple) {
  constexpr int few = 4;
  Isolated isolated;
  std::vector<Part> parts{Part(*p, 0, 1)};  // a stack with the lowest part on top
  for (int tries = 0; !parts.empty();) {
    Part part = std::move(parts.back());
    parts.pop_back();
    const int changes = part.on.changes();
    if (changes == 1) isolated.roots.emplace_back(p, part.lo, part.hi);
    if (changes < 2) continue;
    Numbers cuts;
    if (++tries > few) {
      if (!is_simple) return {{}, {}, false};
      cuts = part.shrink(*p);
      if (part.lo == part.hi) continue;
    }
    if (cuts.empty()) {
      const double guess = part.at_extremum ? part.on.guess_extremum() : 0.5;
      const double around_it = part.at_extremum ? around : 0;
      cuts = {part.at(guess + around_it), part.at(guess - around_it)};
      part.at_extremum = !part.at_extremum;
    }
    const auto add_part = [&](const Number& lo, const Number& hi) {
      parts.emplace_back(*p, lo, hi);
      parts.back().at_extremum = part.at_extremum;
      parts.back().bits = part.bits;
    };
    Number hi = part.hi;
    for (const Number& lo : cuts) {
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
