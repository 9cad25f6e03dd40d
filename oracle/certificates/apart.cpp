// Moving planes prove that a pair stays apart. While the distance is above the separation, two directions
// separate the primitives strictly: the direction between the closest points, and the normal of the closest
// features, which moves with these features (tools/certificates/README.md gives its formulas). A direction
// that separates the primitives at a time also separates them for a while, and the span [from, to] is
// compact. So the search, which cuts the span into parts, comes to an end, unless the smallest distance is
// exactly the separation. Near a time at which the closest features change, parts may have to be very short.
// The cuts approach such a time as fast as a root finder approaches a root.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "oracle/certificates/certificate.hpp"
#include "oracle/certificates/normal.hpp"
#include "oracle/certificates/text.hpp"
#include "oracle/distance/closest.hpp"
#include "oracle/exact/moving.hpp"
#include "oracle/exact/root.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

namespace {

using namespace exact;
using certificates::FeatureNormal;
using certificates::Gaps;
using certificates::Interval;
using certificates::Normal;
using certificates::RoughVector;
using certified::ClosestFeatures;

constexpr int most_tries = 50'000;  ///< most tests of whether a normal separates in an interval
constexpr int most_tries_if_reached = 500;
constexpr int most_depth = 8'000;
/// In parts wider than this, double is precise enough to find the closest features.
constexpr double width_of_doubles = 0x1p-50;
constexpr int all_features_from = 6;  ///< from this depth on, the normals of all features are tried
/// From this depth on, cuts approach times of change (time_of_change()), and the normals of features are no
/// longer rounded. Each normal is then tested first in the middle of a part, then in all of the part.
constexpr int deep = 16;

struct Piece {
  Interval at;
  Normal normal;
  bool may_be_rounded = false;  ///< whether round() tries rounded normals
  bool is_extended = false;     ///< whether extend() was applied to this piece
};

/// A part of the step for which the search must find a normal that separates the primitives.
struct Part {
  Interval at;
  int depth = 0;                         ///< the number of cuts that led to this part
  const Polynomial* obstacle = nullptr;  ///< the obstacle that first_obstacle() found before the last cut
  std::optional<Root> change = {};       ///< the time of change of the obstacle, if it is in this part
  bool is_beside_a_change = false;  ///< whether the last cut approached a time of change outside this part

  [[nodiscard]] bool is_point() const { return at.lo == at.hi; }
};

/// The polynomial p divided by all its factors that vanish at t.
Polynomial without_root(Polynomial p, const Number& t) {
  while (!p.is_zero() && p.sign_at(t) == 0) p = divide(p, Polynomial({-t, 1})).quotient;
  return p;
}

/// The only root of a polynomial in an interval, if the Bernstein coefficients show that the polynomial has
/// exactly one root in the interval. Otherwise the result is nothing.
std::optional<Root> only_root(const Polynomial& p, const Interval& in) {
  if (p.sign_at(in.lo) == 0 || p.sign_at(in.hi) == 0) return std::nullopt;
  if (OnInterval(p, in.lo, in.hi).changes() != 1) return std::nullopt;
  return Root(std::make_shared<const Polynomial>(p), in.lo, in.hi);
}

RoughVector constant(const certified::Vec<double>& n) {
  RoughVector result;
  for (std::size_t k = 0; k < 3; ++k)
    if (n[k] != 0) result[k].push_back(n[k]);
  return result;
}

PolynomialVector times(const Polynomial& factor, const PolynomialVector& v) {
  return {factor * v[0], factor * v[1], factor * v[2]};
}

class Separator {
 public:
  /// `reaches_h` says that the distance is at most h at some time. In this case, a proof is found only if the
  /// distance is never below h, and is exactly h only at cuts. So all cuts are in the middle of a part, and
  /// few normals are tried.
  Separator(const Query& query, bool is_strict, bool reaches_h)
      : gaps_(query, is_strict),
        halves_only_(reaches_h),
        tries_left_(reaches_h ? most_tries_if_reached : most_tries) {}

  /// Covers [lo, hi] with pieces or, if `open` is true, [lo, hi). Cuts each part for which it finds no
  /// normal. Returns false if the search gives up.
  bool cover(const Number& lo, const Number& hi, bool open) {
    std::vector<Part> parts{{{lo, hi}}};  // the earliest part is the last element
    while (!parts.empty()) {
      Part part = std::move(parts.back());
      parts.pop_back();
      const bool is_open = open && parts.empty();
      if (find(part, is_open)) continue;
      if (part.is_point() || part.depth >= most_depth || tries_left_ < 0) return false;
      cut(std::move(part), is_open, parts);
    }
    return true;
  }

  /// Extends each piece as far as its normal separates the primitives. Narrow pieces are extended first. In
  /// these pieces, the primitives are closest to each other, and a normal that separates the primitives there
  /// often also separates them in the pieces before and after.
  void merge(bool open) {
    const auto is_before = [](const Piece& a, const Piece& b) {
      return a.is_extended != b.is_extended ? b.is_extended : a.at.width.x < b.at.width.x;
    };
    while (true) {
      const auto narrowest = std::ranges::min_element(pieces_, is_before);
      if (narrowest->is_extended) return;
      extend(static_cast<std::size_t>(narrowest - pieces_.begin()), open);
    }
  }

  /// For some normals, find() tried no rounded versions. Replaces each of these normals by a rounded version
  /// that also separates the primitives, if there is one.
  void round(bool open) {
    for (Piece& piece : pieces_)
      for (const int bits : certificates::roundings) {
        if (!piece.may_be_rounded || bits == 0) break;
        Normal rounded(certificates::rounded(piece.normal.rough(), bits), gaps_);
        if (!rounded.separates(piece.at, open && &piece == &pieces_.back())) continue;
        piece.normal = std::move(rounded);
        break;
      }
  }

  [[nodiscard]] std::vector<Piece>& pieces() { return pieces_; }

 private:
  void extend(std::size_t i, bool open) {
    const auto reaches = [&](std::size_t first, std::size_t last) {
      return pieces_[i].normal.separates({pieces_[first].at.lo, pieces_[last].at.hi},
                                         open && last + 1 == pieces_.size());
    };
    std::size_t first = i;
    std::size_t last = i;
    for (std::size_t step = std::bit_floor(pieces_.size()); step > 0; step /= 2) {
      if (last + step < pieces_.size() && reaches(first, last + step)) last += step;
      if (first >= step && reaches(first - step, last)) first -= step;
    }
    pieces_[i].at = {pieces_[first].at.lo, pieces_[last].at.hi};
    pieces_[i].is_extended = true;
    std::swap(pieces_[first], pieces_[i]);
    pieces_.erase(pieces_.begin() + static_cast<std::ptrdiff_t>(first) + 1,
                  pieces_.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  }

  /// Cuts a part in the middle or, from the depth `deep` on, around a time of change if one is known. The
  /// pieces next to such a time may be as short as 2^-2000.
  void cut(Part&& part, bool open, std::vector<Part>& parts) {
    auto& [at, depth, obstacle, change, is_beside] = part;
    const Polynomial* const before = obstacle;
    obstacle = halves_only_ || depth < deep ? nullptr : first_obstacle(at, open);
    if (obstacle == nullptr || (is_beside && obstacle == before))
      change = {};
    else if (!change || obstacle != before)
      change = time_of_change(*obstacle, at);
    if (change) approach(*change, at);
    const Number first = change ? change->lo() : between(at.lo, at.hi, 0.5);
    const Number last = change ? change->hi() : first;
    if (last < at.hi) parts.push_back({{last, at.hi}, depth + 1, obstacle, {}, change.has_value()});
    if (first < last) parts.push_back({{first, last}, depth + 1, obstacle, change});
    if (at.lo < first) parts.push_back({{at.lo, first}, depth + 1, obstacle, {}, change.has_value()});
  }

  /// Refines a root until its interval is at most 2^20 times as long as the distance from this interval to
  /// either end of the part.
  static void approach(Root& root, const Interval& in) {
    constexpr int most_refinements = 40;
    const Number much = 0x1p-20;
    for (int i = 0; i < most_refinements; ++i) {
      root.refine();
      const Number width = much * (root.hi() - root.lo());
      if (width <= root.lo() - in.lo && width <= in.hi - root.hi()) return;
    }
  }

  /// The obstacle of a normal is the polynomial whose sign keeps the normal from separating the primitives in
  /// all of a part. Returns the obstacle of the normal that separates the primitives in the middle of the
  /// part. But if this obstacle is 0 at an end of the part, and a normal is known that separates the
  /// primitives at that end, returns the obstacle of that normal.
  const Polynomial* first_obstacle(const Interval& in, bool open) {
    const auto of = [&](Normal* normal) -> const Polynomial* {
      for (std::size_t gap = 0; normal != nullptr && gap < gaps_.size(); ++gap)
        if (const Polynomial* const obstacle = normal->obstacle(gap, in, open)) return obstacle;
      return nullptr;
    };
    const Polynomial* obstacle = of(in_the_middle_);
    for (const Number& end : {in.lo, in.hi})
      if (obstacle != nullptr && obstacle->sign_at(end) == 0)
        if (const Polynomial* const other = of(normal_at(end))) obstacle = other;
    return obstacle;
  }

  Normal* normal_at(const Number& t) {
    for (auto& [features, normals] : normals_)
      if (Normal& exact = normals.in_front_at(t).back(); exact.separates_at(t)) return &exact;
    return nullptr;
  }

  /// The root of an obstacle in a part, if the obstacle has exactly one root there. Otherwise the root of the
  /// lowest derivative that has exactly one root there. At this root, the obstacle changes its sign or has an
  /// extremum, or the root is the centre of several such times. Roots at the ends of the part do not count.
  [[nodiscard]] static std::optional<Root> time_of_change(const Polynomial& obstacle, const Interval& in) {
    Polynomial p = without_root(without_root(obstacle, in.lo), in.hi);
    for (; p.degree() >= 1; p = p.derivative())
      if (auto root = only_root(p, in)) return root;
    return std::nullopt;
  }

  /// Finds a normal that separates the primitives in all of a part.
  bool find(const Part& part, bool open) {
    in_the_middle_ = nullptr;
    if (part.at.width.x > width_of_doubles) {
      const double t = CGAL::to_double(between(part.at.lo, part.at.hi, 0.5));
      const auto points = certified::closest_points(certified::VerticesAt<double>(gaps_.differences(), t));
      const RoughVector direction = constant(points.difference);
      for (const int bits : certificates::roundings) {
        Normal normal(bits > 0 ? certificates::rounded(direction, bits) : direction, gaps_);
        if (take(normal, part, open)) return true;
      }
      if (take_normal(points.features, part, open)) return true;
    }
    if (part.depth < all_features_from && !part.is_point()) return false;
    const Topology& of = topology(gaps_.kind());
    using Combination = ClosestFeatures::Combination;
    for (const auto& [from, to] : of.gaps)
      if (take_normal({Combination::vertices, from, to, to}, part, open)) return true;
    for (const auto& [vertex, from, to] : of.vertices_and_edges)
      if (take_normal({Combination::vertex_and_edge, vertex, from, to}, part, open)) return true;
    return take_normal({Combination::interiors}, part, open);
  }

  /// Tries the normal of these features as the separating direction. If only the opposite normal can separate
  /// the primitives in the middle of the part, tries the opposite normal instead. In parts with a depth below
  /// `deep`, also tries rounded versions of the normal.
  bool take_normal(const ClosestFeatures& features, const Part& part, bool open) {
    const std::array key{static_cast<std::size_t>(features.combination), features.vertex, features.from,
                         features.to};
    auto known = normals_.find(key);
    if (known == normals_.end())
      known = normals_.emplace(key, FeatureNormal(normal_of(features), gaps_)).first;
    const Number middle = between(part.at.lo, part.at.hi, 0.5);
    auto& normals = known->second.in_front_at(middle);
    Normal& exact = normals.back();
    if (part.depth < deep)
      return !exact.clearly_fails(part.at) &&
             std::ranges::any_of(normals, [&](Normal& each) { return take(each, part, open); });
    if (!exact.separates_at(middle)) return false;
    if (in_the_middle_ == nullptr) in_the_middle_ = &exact;
    return take(exact, part, open, true);
  }

  [[nodiscard]] PolynomialVector normal_of(const ClosestFeatures& features) {
    const auto& x = gaps_.points();
    const PolynomialVector p = x[features.vertex] - x[features.from];
    switch (features.combination) {
      case ClosestFeatures::Combination::vertices:
        return p;
      case ClosestFeatures::Combination::vertex_and_edge: {
        const PolynomialVector e = x[features.to] - x[features.from];
        return times(dot(e, e), p) - times(dot(p, e), e);
      }
      case ClosestFeatures::Combination::interiors:
        break;
    }
    const auto& [unused, q, r] = topology(gaps_.kind()).pqr;
    return cross(x[q.to] - x[q.from], x[r.to] - x[r.from]);
  }

  bool take(Normal& normal, const Part& part, bool open, bool may_be_rounded = false) {
    if (--tries_left_ < 0 || !normal.separates(part.at, open)) return false;
    pieces_.push_back({part.at, normal, may_be_rounded});
    return true;
  }

  Gaps gaps_;
  std::map<std::array<std::size_t, 4>, FeatureNormal> normals_;
  /// A normal that separates the primitives in the middle of the part that find() tried last, or null.
  Normal* in_the_middle_ = nullptr;
  std::vector<Piece> pieces_;
  bool halves_only_;
  int tries_left_;
};

/// Whether the distance is at most h at some time in a span; false for a span that does not begin at 0.
bool is_reached(const Query& query, const Span& span) {
  if (span.from != 0) return false;
  auto time = earliest_time(query);
  return time && time->is_before(span.is_open ? span.to : std::nextafter(span.to, 2));
}

}  // namespace

std::optional<std::string> certify_apart(const Query& query, const Span& span, bool is_strict,
                                         bool is_known) {
  const PlainArithmetic guard;
  const bool reaches_h = !is_known && is_reached(query, span);
  if (is_strict && reaches_h) return std::nullopt;
  Separator separator(query, is_strict, reaches_h);
  if (!separator.cover(span.from, span.to, span.is_open)) return std::nullopt;
  separator.merge(span.is_open);
  separator.round(span.is_open);
  using namespace certificates;
  const auto number = [](const Number& x) { return quoted(certificates::to_text(x)); };
  const auto polynomial = [&](const Polynomial& p) {
    return p.is_zero() ? std::string(R"(["0"])") : list(p.coefficients(), number);
  };
  std::string text = heading(query, "apart", span.from, to_text(Number(span.to))) +
                     (span.is_open ? R"(,"open":true)" : "") + (is_strict ? "" : R"(,"strict":false)");
  std::vector<Number> times{Number(span.from)};
  for (const Piece& piece : separator.pieces()) times.push_back(piece.at.hi);
  text += R"(,"times":)" + list(times, number);
  text += R"(,"normals":)" +
          list(separator.pieces(), [&](Piece& piece) { return list(piece.normal.exact(), polynomial); });
  return if_short(text + "}");
}

}  // namespace nearmiss
