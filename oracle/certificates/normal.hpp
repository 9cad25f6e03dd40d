// Directions that separate two primitives, as the checkers of certificates see them.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "oracle/arithmetic/vectors.hpp"
#include "oracle/exact/moving.hpp"
#include "oracle/exact/polynomial.hpp"

namespace nearmiss::certificates {

using exact::Number;
using exact::Polynomial;
using exact::PolynomialVector;

/// A vector of polynomials in doubles. It quickly rejects directions that do not separate the primitives.
/// Only exact arithmetic accepts one.
class RoughVector {
 public:
  explicit RoughVector(const PolynomialVector& v);

  /// The approximate value at t. Its rounding errors are at most a constant factor times `size`.
  struct Value {
    certified::Vec<double> v{}, size{};
  };
  /// The value at t in [0, 1].
  [[nodiscard]] Value at(double t) const;

 private:
  std::array<std::vector<double>, 3> coefficients_;
};

/// The differences of a vertex of the first primitive and one of the second. A direction separates the
/// primitives if all differences are longer than h along it.
struct Gaps {
  Gaps(std::vector<PolynomialVector> differences, const Number& separation, bool strictly);

  std::vector<PolynomialVector> exact;
  std::vector<RoughVector> rough;
  Number squared_h;
  double h;        ///< the separation, rounded
  bool is_strict;  ///< if not, a length of exactly h > 0 suffices
};

/// A direction that moves with time. The gaps must outlive it.
class Normal {
 public:
  Normal(PolynomialVector n, const Gaps& gaps) : n_(std::move(n)), rough_(n_), gaps_(&gaps) {}

  [[nodiscard]] const PolynomialVector& vector() const { return n_; }

  /// Whether the direction clearly does not separate the primitives at an end of [lo, hi] or in the middle.
  [[nodiscard]] bool clearly_fails(const Number& lo, const Number& hi) const;

  /// Whether the checkers see that the direction separates the primitives in all of [lo, hi] or, if `open`,
  /// [lo, hi).
  [[nodiscard]] bool separates(const Number& lo, const Number& hi, bool open);

  /// Whether the first primitive is behind the second one at t, seen in this direction, judged by their first
  /// vertices.
  [[nodiscard]] bool is_behind_at(const Number& t) { return along(0).n_d.sign_at(t) < 0; }

 private:
  /// For one gap d: n · d, and for h > 0 also (n · d)² - h² n · n. They are computed on first use.
  struct Along {
    Polynomial n_d, excess;
  };
  const Along& along(std::size_t gap);

  PolynomialVector n_;
  RoughVector rough_;
  const Gaps* gaps_;
  std::vector<std::optional<Along>> along_;
  std::optional<Polynomial> least_;  ///< h² n · n
};

/// The numbers of bits to which normals are rounded, one after the other; 0: not rounded.
constexpr std::array roundings{6, 20, 50, 0};

/// The vector with its coefficients rounded to integers, the largest of about `bits` bits; the vector itself
/// if `bits` is 0.
PolynomialVector rounded(const PolynomialVector& n, int bits);

/// The normal of a pair of features in both directions, rounded to integers of various sizes.
class FeatureNormal {
 public:
  FeatureNormal(const PolynomialVector& n, const Gaps& gaps);

  /// The versions of the direction in which the first primitive is in front of the second one at t, judged by
  /// their first vertices. The version with the smallest integers comes first, and the one that is not
  /// rounded last.
  [[nodiscard]] std::vector<Normal>& in_front_at(const Number& t);

 private:
  std::vector<Normal> forwards_, backwards_;
};

}  // namespace nearmiss::certificates
