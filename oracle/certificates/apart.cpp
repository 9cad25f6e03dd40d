// Planes prove that a pair stays apart. At any time, the direction between the closest points separates the
// primitives strictly. So does the normal of the closest features, which moves with them: x - y for two
// vertices, (e·e) p - (p·e) e for a vertex and an edge e, q × r for interiors. A direction that separates at
// a time also separates for a while, and [from, to] is compact. So a search that cuts [from, to] into parts
// ends, unless the smallest distance is exactly h.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <map>
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
using certificates::Normal;
using certified::ClosestFeatures;

constexpr int most_tries = 500'000;  ///< tests of a normal on an interval
constexpr int most_tries_if_reached = 500;
constexpr int most_depth = 8'000;
constexpr int depth_of_doubles = 50;  ///< at smaller depths, doubles show which features are closest
constexpr int all_features_from = 6;  ///< the depth from which on the normals of all features are tried

struct Piece {
  Number lo, hi;
  Normal normal;
  bool is_extended = false;  ///< whether it extends as far as its normal separates
};

/// A part of the step for which a normal is to be found.
struct Part {
  Number lo, hi;
  int depth = 0;                 ///< the part was halved at least this many times
  int kept_lo = 0, kept_hi = 0;  ///< how many cuts in a row kept this end

  /// The parts after and before a cut, which is in the middle at first. If `may_be_uneven` and many cuts in a
  /// row kept one end, the part at that end gets 2^-n of the length, and n grows with each cut: what happens
  /// near an end may last only 2^-2000.
  [[nodiscard]] std::array<Part, 2> cut(bool may_be_uneven) const {
    constexpr int usual = 4;
    const int kept = std::max(kept_lo, kept_hi);
    const int n = may_be_uneven && kept > usual ? kept : 1;
    const bool is_near_lo = kept_lo >= kept_hi;
    const double part = std::ldexp(1.0, -n);
    const Number at = is_near_lo ? between(lo, hi, part) : between(hi, lo, part);
    return {{{at, hi, depth + (is_near_lo ? 1 : n), 0, kept_hi + 1},
             {lo, at, depth + (is_near_lo ? n : 1), kept_lo + 1, 0}}};
  }
};

PolynomialVector constant(const certified::Vec<double>& n) {
  PolynomialVector result;
  for (std::size_t k = 0; k < 3; ++k) result[k] = Polynomial({Number(n[k])});
  return result;
}

PolynomialVector times(const Polynomial& factor, const PolynomialVector& v) {
  return {factor * v[0], factor * v[1], factor * v[2]};
}

Gaps gaps_of(const Query& query, const exact::Unit& unit, const std::array<PolynomialVector, 4>& x,
             bool is_strict) {
  std::vector<PolynomialVector> differences;
  for (const auto& [from, to] : topology(query.kind).gaps) differences.push_back(x[from] - x[to]);
  return {std::move(differences), unit.scaled(query.separation), is_strict};
}

/// Separates the primitives of a query piece by piece.
class Separator {
 public:
  /// `reaches_h`: the primitives come within h. A proof then exists only if they do so at a cut, so all cuts
  /// are in the middle, and few normals are tried.
  Separator(const Query& query, bool is_strict, bool reaches_h)
      : kind_(query.kind),
        unit_(query),
        differences_(query),
        x_(moving_points(query, unit_)),
        gaps_(gaps_of(query, unit_, x_, is_strict)),
        cuts_unevenly_(!reaches_h),
        tries_left_(reaches_h ? most_tries_if_reached : most_tries) {}

  /// Covers [lo, hi], or [lo, hi) if `open`, with pieces, and cuts each part for which it finds no normal.
  /// Returns false if it gives up.
  bool cover(const Number& lo, const Number& hi, bool open) {
    std::vector<Part> parts{{lo, hi}};  // the earliest part is the last element
    while (!parts.empty()) {
      const Part part = std::move(parts.back());
      parts.pop_back();
      if (find(part, open && parts.empty())) continue;
      if (part.depth >= most_depth || tries_left_ < 0) return false;
      for (Part& each : part.cut(cuts_unevenly_)) parts.push_back(std::move(each));
    }
    return true;
  }

  /// Extends pieces over their neighbours, narrow ones first, because a normal that separates where the
  /// primitives are nearest often separates before and after, too.
  void merge(bool open) {
    const auto is_before = [](const Piece& a, const Piece& b) {
      return a.is_extended != b.is_extended ? b.is_extended : a.hi - a.lo < b.hi - b.lo;
    };
    while (true) {
      const auto narrowest = std::ranges::min_element(pieces_, is_before);
      if (narrowest->is_extended) return;
      extend(static_cast<std::size_t>(narrowest - pieces_.begin()), open);
    }
  }

  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }

 private:
  /// Extends piece i as far as its normal separates the primitives.
  void extend(std::size_t i, bool open) {
    const auto reaches = [&](std::size_t first, std::size_t last) {
      return pieces_[i].normal.separates(pieces_[first].lo, pieces_[last].hi,
                                         open && last + 1 == pieces_.size());
    };
    std::size_t first = i;
    std::size_t last = i;
    for (std::size_t step = std::bit_floor(pieces_.size()); step > 0; step /= 2) {
      if (last + step < pieces_.size() && reaches(first, last + step)) last += step;
      if (first >= step && reaches(first - step, last)) first -= step;
    }
    pieces_[i] = {pieces_[first].lo, pieces_[last].hi, std::move(pieces_[i].normal), true};
    std::swap(pieces_[first], pieces_[i]);
    pieces_.erase(pieces_.begin() + static_cast<std::ptrdiff_t>(first) + 1,
                  pieces_.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  }

  /// Finds a normal that separates the primitives in all of a part.
  bool find(const Part& part, bool open) {
    if (part.depth < depth_of_doubles) {
      const double t = CGAL::to_double(between(part.lo, part.hi, 0.5));
      const auto points = certified::closest_points(certified::VerticesAt<double>(differences_, t));
      for (const int bits : certificates::roundings) {
        Normal normal(certificates::rounded(constant(points.difference), bits), gaps_);
        if (take(normal, part, open)) return true;
      }
      if (take_normal(points.features, part, open)) return true;
    }
    if (part.depth < all_features_from) return false;
    const Topology& of = topology(kind_);
    using Combination = ClosestFeatures::Combination;
    for (const auto& [from, to] : of.gaps)
      if (take_normal({Combination::vertices, from, to, to}, part, open)) return true;
    for (const auto& [vertex, from, to] : of.vertices_and_edges)
      if (take_normal({Combination::vertex_and_edge, vertex, from, to}, part, open)) return true;
    return take_normal({Combination::interiors}, part, open);
  }

  /// Tries the normal of these features, with the sign that separates the primitives in the middle of the
  /// part.
  bool take_normal(const ClosestFeatures& features, const Part& part, bool open) {
    const std::array key{static_cast<std::size_t>(features.combination), features.vertex, features.from,
                         features.to};
    auto known = normals_.find(key);
    if (known == normals_.end())
      known = normals_.emplace(key, FeatureNormal(normal_of(features), gaps_)).first;
    auto& normals = known->second.in_front_at(between(part.lo, part.hi, 0.5));
    return !normals.back().clearly_fails(part.lo, part.hi) &&
           std::ranges::any_of(normals, [&](Normal& each) { return take(each, part, open); });
  }

  [[nodiscard]] PolynomialVector normal_of(const ClosestFeatures& features) const {
    const PolynomialVector p = x_[features.vertex] - x_[features.from];
    switch (features.combination) {
      case ClosestFeatures::Combination::vertices:
        return p;
      case ClosestFeatures::Combination::vertex_and_edge: {
        const PolynomialVector e = x_[features.to] - x_[features.from];
        return times(dot(e, e), p) - times(dot(p, e), e);
      }
      case ClosestFeatures::Combination::interiors:
        break;
    }
    const auto& [unused, q, r] = topology(kind_).pqr;
    return cross(x_[q.to] - x_[q.from], x_[r.to] - x_[r.from]);
  }

  /// Keeps a piece with this normal if it separates the primitives.
  bool take(Normal& normal, const Part& part, bool open) {
    if (--tries_left_ < 0 || !normal.separates(part.lo, part.hi, open)) return false;
    pieces_.push_back({part.lo, part.hi, normal});
    return true;
  }

  Kind kind_;
  exact::Unit unit_;
  certified::VertexDifferences differences_;
  std::array<PolynomialVector, 4> x_;
  Gaps gaps_;
  std::map<std::array<std::size_t, 4>, FeatureNormal> normals_;
  std::vector<Piece> pieces_;
  bool cuts_unevenly_;
  int tries_left_;
};

/// Whether the primitives come within h in a span that begins with the step. Then the search for normals ends
/// only if the distance never falls below h, and is exactly h only at ends of pieces.
bool is_reached(const Query& query, const Span& span) {
  if (span.from != 0) return false;
  auto time = earliest_time(query);
  return time && time->is_before(span.is_open ? span.to : std::nextafter(span.to, 2));
}

}  // namespace

std::optional<std::string> certify_apart(const Query& query, const Span& span, bool is_strict) {
  const PlainArithmetic guard;
  const bool reaches_h = is_reached(query, span);
  if (is_strict && reaches_h) return std::nullopt;
  Separator separator(query, is_strict, reaches_h);
  if (!separator.cover(span.from, span.to, span.is_open)) return std::nullopt;
  separator.merge(span.is_open);
  using namespace certificates;
  const auto number = [](const Number& x) { return quoted(certificates::to_text(x)); };
  const auto polynomial = [&](const Polynomial& p) {
    return p.is_zero() ? std::string(R"(["0"])") : list(p.coefficients(), number);
  };
  std::string text = heading(query, "apart", span.from, to_text(Number(span.to))) +
                     (span.is_open ? R"(,"open":true)" : "") + (is_strict ? "" : R"(,"strict":false)");
  std::vector<Number> times{Number(span.from)};
  for (const Piece& piece : separator.pieces()) times.push_back(piece.hi);
  text += R"(,"times":)" + list(times, number);
  text += R"(,"normals":)" + list(separator.pieces(), [&](const Piece& piece) {
            return list(piece.normal.vector(), polynomial);
          });
  return if_short(text + "}");
}

}  // namespace nearmiss
