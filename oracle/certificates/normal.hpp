// Directions that separate two primitives, according to the tests that the checkers of certificates use.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <tuple>
#include <vector>

#include "ccd/query/query.hpp"
#include "oracle/certificates/rough.hpp"
#include "oracle/distance/vertex_differences.hpp"
#include "oracle/exact/moving.hpp"
#include "oracle/exact/polynomial.hpp"

namespace nearmiss::certificates {

using exact::Polynomial;
using exact::PolynomialVector;

/// The gaps of a query: the vectors from each vertex of the second primitive to each vertex of the first. A
/// direction separates the primitives if each gap, measured along this direction, is longer than h. If
/// `is_strict` is false, a gap may also be equal to h > 0.
class Gaps {
 public:
  Gaps(const Query& query, bool is_strict);

  [[nodiscard]] Kind kind() const { return differences_.kind(); }
  [[nodiscard]] bool is_strict() const { return is_strict_; }
  [[nodiscard]] bool has_separation() const { return query_.separation > 0; }
  [[nodiscard]] const certified::VertexDifferences& differences() const { return differences_; }

  /// The exact positions of the vertices.
  const std::array<PolynomialVector, 4>& points();

  [[nodiscard]] std::size_t size() const { return rough_.size(); }
  /// A gap, in exact polynomials or in rough ones. Exact and rough gaps have different units.
  template <class AnyPolynomial>
  [[nodiscard]] const certified::Vec<AnyPolynomial>& vector(std::size_t gap);
  /// h², in the square of the gaps' unit.
  template <class AnyPolynomial>
  [[nodiscard]] AnyPolynomial squared_h() const;

 private:
  Query query_;
  bool is_strict_;
  exact::Unit unit_;
  certified::VertexDifferences differences_;
  std::vector<RoughVector> rough_;
  std::optional<std::array<PolynomialVector, 4>> points_;
  std::vector<PolynomialVector> exact_;
};

/// A direction that may change with time. The gaps must outlive this object.
class Normal {
 public:
  Normal(const PolynomialVector& n, Gaps& gaps);
  /// A direction whose coefficients are doubles without an error.
  Normal(const RoughVector& n, Gaps& gaps) : rough_(n), gaps_(&gaps) {}

  [[nodiscard]] const PolynomialVector& exact();
  [[nodiscard]] const RoughVector& rough() const { return rough_; }

  /// Whether the direction clearly does not separate the primitives at an end of the interval or in its
  /// middle.
  [[nodiscard]] bool clearly_fails(const Interval& interval);

  /// Whether the checkers accept that the direction separates the primitives in all of an interval [lo, hi]
  /// or, if `open`, [lo, hi).
  [[nodiscard]] bool separates(const Interval& interval, bool open);
  [[nodiscard]] bool separates_at(const Number& t);
  /// The polynomial of this gap whose sign makes separates() false; null if no polynomial of this gap does
  /// so.
  [[nodiscard]] const Polynomial* obstacle(std::size_t gap, const Interval& interval, bool open);

  /// Whether, along this direction, the first vertex of the first primitive is behind the first vertex of the
  /// second primitive at t.
  [[nodiscard]] bool is_behind_at(const Number& t);

 private:
  /// For this direction n and a gap d: n · d, and for h > 0 also (n · d)² - h² n · n.
  template <class AnyPolynomial>
  struct Along {
    AnyPolynomial n_d, excess;
  };
  /// The products of the direction with all gaps, computed on first use.
  template <class AnyPolynomial>
  struct Products {
    std::optional<AnyPolynomial> least;  ///< h² n · n
    std::vector<Along<AnyPolynomial>> along;
  };
  template <class AnyPolynomial>
  const Along<AnyPolynomial>& along(std::size_t gap);

  std::optional<PolynomialVector> n_;
  RoughVector rough_;
  Gaps* gaps_;
  std::tuple<Products<Polynomial>, Products<RoughPolynomial>> products_;
};

/// The numbers of bits to which normals are rounded, in the order of the attempts; 0 means not rounded.
constexpr std::array roundings{6, 20, 50, 0};

/// A multiple of n, whose coefficients are rounded to integers of at most about `bits` bits. The result is 0
/// if n is tiny.
RoughVector rounded(const RoughVector& n, int bits);

/// The normal of a pair of features, and the opposite normal. Each of these two normals has several versions:
/// one version is not rounded, and the others are rounded to integers of different sizes.
class FeatureNormal {
 public:
  FeatureNormal(const PolynomialVector& n, Gaps& gaps) : gaps_(&gaps), exact_(n, gaps) {}

  /// The versions of the normal or, if the normal is_behind_at(t), the versions of the opposite normal. The
  /// version with the smallest integers comes first, and the version that is not rounded comes last.
  [[nodiscard]] std::vector<Normal>& in_front_at(const Number& t);

 private:
  Gaps* gaps_;
  Normal exact_;
  std::vector<Normal> forwards_, backwards_;
};

}  // namespace nearmiss::certificates
