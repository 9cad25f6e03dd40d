// Finds the real roots of a polynomial in [0, 1].
#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "oracle/exact/root.hpp"

namespace nearmiss::exact {

namespace {

/// The result of isolate() for a polynomial that is not zero at 0 or 1. `roots` has its roots in (0, 1), in
/// ascending order. But if a cut has hit a root exactly, `number` is this root, and `roots` is empty. `found`
/// is false if the search has given up.
struct Isolated {
  std::vector<Root> roots;
  std::optional<Number> number;
  bool found = true;
};

/// How to cut a part. All numbers are fractions of the part. There is no root outside [lo, hi]; `at` has the
/// cuts inside [lo, hi], the highest one first.
struct Cuts {
  Number lo, hi;
  Numbers at;
};

/// A part of the step, and how it is cut next.
struct Part {
  Number lo, hi;
  OnInterval on;
  /// Whether the next call of usual() cuts near an extremum; otherwise it cuts in the middle.
  bool at_extremum = true;
  unsigned bits = 44;          ///< see clusters()
  bool is_in_cluster = false;  ///< whether clusters() was called; coefficients may then be long

  explicit Part(const Polynomial& p) : lo(0), hi(1), on(p, 0, 1) {}
  /// The part of `whole` between the fractions `from` and `to` of `whole`.
  Part(const Polynomial& p, const Part& whole, const Number& from, const Number& to)
      : lo(whole.at(from)),
        hi(whole.at(to)),
        on(whole.on.part(from, to)),
        at_extremum(whole.at_extremum),
        bits(whole.bits),
        is_in_cluster(whole.is_in_cluster) {
    if (is_in_cluster) on.round();
    if (!on.is_certain()) on = OnInterval(p, lo, hi);
  }

  [[nodiscard]] Number at(const Number& fraction) const { return lo + fraction * (hi - lo); }

  Cuts usual() {
    const double guess = at_extremum ? on.guess_extremum() : 0.5;
    const double around_it = at_extremum ? around : 0;
    at_extremum = !at_extremum;
    return {0, 1, {Number(guess + around_it), Number(guess - around_it)}};
  }

  /// Looks for clusters of roots. Shrinks the part to the neighbourhood of a cluster if the coefficients on
  /// this neighbourhood have as many changes of sign as the coefficients on the part, because the rest of the
  /// part then has no root. Returns cuts that separate clusters, if it finds any.
  std::optional<Cuts> clusters(const Polynomial& p) {
    constexpr unsigned least_bits = 11;
    is_in_cluster = true;
    for (bool shrunk = false;; shrunk = true) {
      if (const auto near_end = on.roots_near_end())
        return Cuts{near_end->lower, near_end->upper, {near_end->middle}};
      // Each round shrinks the part around a multiple of 2^-bits, and doubles `bits`. Rounds succeed until
      // the distance of this multiple from the roots of the cluster is no larger than the distances between
      // these roots.
      const auto cluster = on.guess_cluster(bits);
      if (!cluster) break;
      const Number unit = power_of_half(bits);
      const Number below = std::max(Number(0), *cluster - unit);
      const Number above = std::min(Number(1), *cluster + unit);
      Part near_cluster(p, *this, below, above);
      if (near_cluster.on.changes() != on.changes()) {
        if (!shrunk) break;
        bits = least_bits;
        return Cuts{0, 1, {above, below}};
      }
      *this = std::move(near_cluster);
      bits *= 2;
    }
    bits = std::max(least_bits, bits / 2);
    return std::nullopt;
  }
};

/// Cuts [0, 1] until every part has no root or one simple root. Cuts near an extremum, which separate two
/// close roots, alternate with cuts in the middle. `is_simple` says that the polynomial has no multiple
/// roots. If `is_simple` is false, the search gives up after a few cuts. If it is true, the search looks for
/// clusters of roots after a few cuts.
Isolated isolate(const std::shared_ptr<const Polynomial>& p, bool is_simple) {
  constexpr int few = 4;
  Isolated isolated;
  std::vector<Part> parts{Part(*p)};  // a stack with the lowest part on top
  for (int tries = 0; !parts.empty();) {
    Part part = std::move(parts.back());
    parts.pop_back();
    const int changes = part.on.changes();
    if (changes == 1) isolated.roots.emplace_back(p, part.lo, part.hi, sign(part.on.coefficients().front()));
    if (changes < 2) continue;
    std::optional<Cuts> cuts;
    if (++tries > few) {
      if (!is_simple) return {{}, {}, false};
      cuts = part.clusters(*p);
    }
    if (!cuts) cuts = part.usual();
    Number hi = cuts->hi;
    cuts->at.push_back(cuts->lo);
    for (const Number& lo : cuts->at) {
      if (!(cuts->lo <= lo && lo < hi)) continue;
      parts.emplace_back(*p, part, lo, hi);
      const bool is_root = CGAL::is_zero(parts.back().on.coefficients().front());
      if (is_root) return {{}, parts.back().lo};
      hi = lo;
    }
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
