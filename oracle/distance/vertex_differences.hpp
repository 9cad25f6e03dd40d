// Positions of the vertices of a query relative to each other.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "ccd/query/query.hpp"
#include "oracle/arithmetic/double_word.hpp"
#include "oracle/arithmetic/vectors.hpp"

namespace nearmiss::certified {

/// The vectors p, q and r (x_to - x_from), with the normal N = q × r and the coplanarity cubic F = p · N. For
/// vertex and triangle, they are x0 - x1, x2 - x1 and x3 - x1; for edges, x0 - x2, x0 - x1 and x3 - x2. So
/// the feet of the common normal have the weights a and b that solve p = a q + b r + c N.
struct NormalPairs {
  VertexPair p, q, r;
};
constexpr NormalPairs normal_pairs(Kind kind) {
  const auto& [p, q, r] = topology(kind).pqr;
  if (has_triangle(kind)) return {p, q, r};
  return {{p.to, p.from}, {q.to, q.from}, r};
}

/// The number of the pair of two different vertices, from 0 to 5.
constexpr std::size_t number_of_pair(std::size_t i, std::size_t j) {
  constexpr std::array<std::array<std::size_t, 4>, 4> numbers{
      {{0, 0, 1, 2}, {0, 0, 3, 4}, {1, 3, 0, 5}, {2, 4, 5, 0}}};
  return numbers[i][j];
}

/// Calls `use(i, j)` with i < j for each pair of vertices of a kind. After inlining, i and j are constants.
template <class Use>
[[gnu::always_inline]] inline void for_each_pair(Kind kind, const Use& use) {
  const int count = vertices(kind);
  use(0, 1);
  if (count > 2) use(0, 2);
  if (count > 3) use(0, 3);
  if (count > 2) use(1, 2);
  if (count > 3) use(1, 3);
  if (count > 3) use(2, 3);
}

/// The differences x_i - x_j of all pairs of vertices at both ends of the step; the differences are 0 for
/// vertices that a query of this kind does not have. The unit is 2^exponent, chosen so that the magnitude of
/// the largest component is between 1 and 2 (all components are 0 if all vertices coincide).
///
/// A difference of doubles is exactly a double word. Scaling this difference to the unit is also exact,
/// except that underflow may change it by at most 2^-1073 of the unit, which is far below `least_distance`.
/// If a difference, or the sum of all magnitudes, would overflow, the coordinates are first divided by 64;
/// the error of this division is far below `least_distance`, too.
class VertexDifferences {
 public:
  explicit VertexDifferences(const Query& query);

  [[nodiscard]] Kind kind() const { return kind_; }
  [[nodiscard]] int exponent() const { return exponent_; }
  /// An upper bound of the distance of x_i and x_j over [0, 1].
  [[nodiscard]] double reach(std::size_t i, std::size_t j) const { return pair_of(i, j).reach; }
  [[nodiscard]] double reach(VertexPair pair) const { return reach(pair.to, pair.from); }
  [[nodiscard]] double total_reach() const { return total_reach_; }

  /// x_i - x_j at the start (0) or the end (1) of the step, for i < j.
  [[nodiscard]] const Vec<DoubleWord>& at(std::size_t time, std::size_t i, std::size_t j) const {
    return pair_of(i, j).at[time];
  }

 private:
  /// Multiplies all differences by 2^exponent, and sets the reaches.
  void scale(int exponent);

  struct VertexDifference {
    std::array<Vec<DoubleWord>, 2> at;
    double reach;
  };
  [[nodiscard]] const VertexDifference& pair_of(std::size_t i, std::size_t j) const {
    return pairs_[number_of_pair(i, j)];
  }

  Kind kind_;
  int exponent_;
  std::array<VertexDifference, 6> pairs_;  // (0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)
  double total_reach_;
};

/// The relative positions and velocities of the vertices at one time. Each component of a position is a sum
/// of two products. A product is rounded at most four times: in 1 - t, in the product, in the sum, and in the
/// conversion of the difference to Real. (The conversion to a double word is exact; the conversion to a
/// longer Real rounds the sum of the two halves.) A velocity is rounded at most twice, and is at most twice
/// as large as reach(i, j).
template <class Real>
class VerticesAt {
 public:
  VerticesAt(const VertexDifferences& differences, const Real& t) : differences_(differences) {
    const Real early = Real(1) - t;
    if (vertices(differences.kind()) < 4) positions_ = velocities_ = {};
    for_each_pair(differences.kind(), [&](std::size_t i, std::size_t j) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Real start = real(differences.at(0, i, j)[k]);
        const Real end = real(differences.at(1, i, j)[k]);
        positions_[i][j][k] = early * start + t * end;
        positions_[j][i][k] = -positions_[i][j][k];
        velocities_[i][j][k] = end - start;
        velocities_[j][i][k] = -velocities_[i][j][k];
      }
    });
  }

  [[nodiscard]] const VertexDifferences& differences() const { return differences_; }

  /// x_i - x_j.
  [[nodiscard]] const Vec<Real>& position(std::size_t i, std::size_t j) const { return positions_[i][j]; }
  [[nodiscard]] const Vec<Real>& position(VertexPair pair) const { return position(pair.to, pair.from); }
  /// The derivative of x_i - x_j with respect to t.
  [[nodiscard]] const Vec<Real>& velocity(std::size_t i, std::size_t j) const { return velocities_[i][j]; }
  [[nodiscard]] const Vec<Real>& velocity(VertexPair pair) const { return velocity(pair.to, pair.from); }

 private:
  using OfPairs = std::array<std::array<Vec<Real>, 4>, 4>;

  static Real real(const DoubleWord& value) {
    if constexpr (std::is_same_v<Real, double>)
      return value.hi;
    else if constexpr (std::is_same_v<Real, DoubleWord>)
      return value;
    else
      return Real(value.hi) + Real(value.lo);
  }

  const VertexDifferences& differences_;
  OfPairs positions_, velocities_;
};

}  // namespace nearmiss::certified
