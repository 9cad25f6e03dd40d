// A pair that is apart is separated by planes. At any time, the direction between the closest points separates
// the primitives strictly, and so does the normal of the closest features, which moves with them: x - y for two
// vertices, (e·e) p - (p·e) e for a vertex and an edge e, q × r for interiors. What separates at a time does so
// for a while, and [from, to] is compact; so bisection ends, unless the smallest distance is exactly h.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "oracle/certificates/certificate.hpp"
#include "oracle/certificates/positive.hpp"
#include "oracle/certificates/text.hpp"
#include "oracle/distance/closest.hpp"
#include "oracle/exact/moving.hpp"
#include "oracle/exact/root.hpp"

namespace nearmiss {

namespace {

using namespace exact;
using certificates::is_nowhere_negative;
using certificates::is_positive;
using certified::ClosestFeatures;

constexpr int most_tries = 500'000;  ///< of a normal in an interval
constexpr int most_depth = 8'000;
constexpr int depth_of_doubles = 50;  ///< below it, doubles tell which features are closest
constexpr int all_features_from = 6;  ///< the depth from which on the normals of all features are tried

/// Bits of the integers to which normals are rounded, in turn; 0: not rounded.
constexpr std::array roundings{6, 20, 50, 0};

struct Piece {
  Number lo, hi;
  PolynomialVector normal;
  bool is_extended = false;  ///< as far as the normal separates the primitives
};

/// A vector whose largest coefficient is about 2^bits, rounded to integers. A bits of 0 leaves it as it is.
PolynomialVector rounded(const PolynomialVector& n, int bits) {
  if (bits == 0) return n;
  double largest = 0;
  for (const Polynomial& p : n)
    for (const Number& c : p.coefficients()) largest = std::max(largest, std::abs(CGAL::to_double(c)));
  if (!(largest > 0x1p-900)) return {};
  PolynomialVector result;
  for (std::size_t k = 0; k < 3; ++k) {
    Numbers coefficients;
    for (const Number& c : n[k].coefficients())
      coefficients.push_back(Number(std::round(std::ldexp(CGAL::to_double(c) / largest, bits))));
    result[k] = Polynomial(std::move(coefficients));
  }
  return result;
}

PolynomialVector constant(const certified::Vec<double>& n) {
  PolynomialVector result;
  for (std::size_t k = 0; k < 3; ++k) result[k] = Polynomial({Number(n[k])});
  return result;
}

PolynomialVector times(const Polynomial& factor, const PolynomialVector& v) {
  return {factor * v[0], factor * v[1], factor * v[2]};
}

/// Separates the primitives of a query piece by piece.
class Separator {
 public:
  Separator(const Query& query, bool is_strict)
      : kind_(query.kind), is_strict_(is_strict), differences_(query) {
    const Unit unit(query);
    x_ = moving_points(query, unit);
    const Number h = unit.scaled(query.separation);
    squared_h_ = h * h;
    for (const auto& [from, to] : topology(kind_).gaps) gaps_.push_back(x_[from] - x_[to]);
  }

  /// Whether the pieces cover [lo, hi], to whose end `open` applies.
  bool cover(const Number& lo, const Number& hi, bool open, int depth = 0) {
    if (find(lo, hi, open, depth)) return true;
    if (depth == most_depth || tries_ > most_tries) return false;
    const Number middle = between(lo, hi, 0.5);
    return cover(lo, middle, false, depth + 1) && cover(middle, hi, open, depth + 1);
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
      return separates(pieces_[i].normal, pieces_[first].lo, pieces_[last].hi,
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

  /// Finds a normal that separates the primitives in all of [lo, hi].
  bool find(const Number& lo, const Number& hi, bool open, int depth) {
    ClosestFeatures closest;
    if (depth < depth_of_doubles) {
      const double t = CGAL::to_double(between(lo, hi, 0.5));
      const auto points = certified::closest_points(certified::VerticesAt<double>(differences_, t));
      closest = points.features;
      for (const int bits : roundings)
        if (take(rounded(constant(points.difference), bits), lo, hi, open)) return true;
      if (take_normal(closest, lo, hi, open)) return true;
    }
    if (depth < all_features_from) return false;
    const Topology& of = topology(kind_);
    using Combination = ClosestFeatures::Combination;
    for (const auto& [from, to] : of.gaps)
      if (take_normal({Combination::vertices, from, to, to}, lo, hi, open)) return true;
    for (const auto& [vertex, from, to] : of.vertices_and_edges)
      if (take_normal({Combination::vertex_and_edge, vertex, from, to}, lo, hi, open)) return true;
    return take_normal({Combination::interiors}, lo, hi, open);
  }

  /// Tries the normal of these features, on the side on which it separates in the middle of [lo, hi].
  bool take_normal(const ClosestFeatures& features, const Number& lo, const Number& hi, bool open) {
    PolynomialVector n = normal_of(features);
    if (dot(n, gaps_[0]).sign_at(between(lo, hi, 0.5)) < 0) n = PolynomialVector{} - n;
    return std::ranges::any_of(roundings, [&](int bits) { return take(rounded(n, bits), lo, hi, open); });
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
  bool take(PolynomialVector normal, const Number& lo, const Number& hi, bool open) {
    if (++tries_ > most_tries || !separates(normal, lo, hi, open)) return false;
    pieces_.push_back({lo, hi, std::move(normal)});
    return true;
  }

  [[nodiscard]] bool separates(const PolynomialVector& n, const Number& lo, const Number& hi,
                               bool open) const {
    const bool has_separation = sign(squared_h_) > 0;
    Polynomial least;
    if (has_separation) least = Polynomial({squared_h_}) * dot(n, n);
    for (const PolynomialVector& d : gaps_) {
      const Polynomial along = dot(n, d);
      if (!is_positive(along, lo, hi, open)) return false;
      if (!has_separation) continue;
      const Polynomial excess = along * along - least;
      if (is_strict_ ? !is_positive(excess, lo, hi, open) : !is_nowhere_negative(excess, lo, hi))
        return false;
    }
    return true;
  }

  Kind kind_;
  bool is_strict_;
  certified::VertexDifferences differences_;
  std::array<PolynomialVector, 4> x_;
  Number squared_h_;
  std::vector<PolynomialVector> gaps_;
  std::vector<Piece> pieces_;
  int tries_ = 0;
};

}  // namespace

std::optional<std::string> certify_apart(const Query& query, const Span& span, bool is_strict) {
  const PlainArithmetic guard;
  Separator separator(query, is_strict);
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
  text += R"(,"normals":)" +
          list(separator.pieces(), [&](const Piece& piece) { return list(piece.normal, polynomial); });
  return text + "}";
}

}  // namespace nearmiss
