// The statements in exact polynomials that decide whether two primitives are within a given distance of each
// other at a given time.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ccd/query/query.hpp"
#include "oracle/exact/moving.hpp"
#include "oracle/exact/root.hpp"

namespace nearmiss::exact {

/// A statement about two features of the primitives, such as a vertex and an edge. It says that the closest
/// points of the lines or planes through the features lie in the features, and are at most b apart.
struct FeatureNearness {
  /// The sorts of the two features. `interiors` means the vertex and the inside of the triangle in a
  /// vertex-triangle query, and the insides of both edges in an edge-edge query.
  enum class Features : std::uint8_t { vertices, vertex_and_edge, interiors };

  Features features{};
  Polynomial excess;                ///< (distance² - b²) times a positive factor; degree 6 at most
  std::vector<Polynomial> outside;  ///< all are at most 0 if the closest points lie in the features
  std::vector<Polynomial> extents;  ///< all are positive unless the features are degenerate

  [[nodiscard]] bool holds_at(Root& t) const {
    return t.sign_of(excess) <= 0 && is_inside_at(t) && is_extended_at(t);
  }
  /// Whether the closest points lie in the features, and are less than b apart (holds_at() allows exactly b).
  [[nodiscard]] bool holds_strictly_at(Root& t) const {
    return t.sign_of(excess) < 0 && is_inside_at(t) && is_extended_at(t);
  }
  [[nodiscard]] bool is_inside_at(Root& t) const;
  [[nodiscard]] bool is_extended_at(Root& t) const;
};

/// The polynomials that the statement about the `interiors` needs. At a time at which squared_N is positive,
/// |F| / |N| is the distance of the vertex from the triangle's plane (vertex-triangle), or the distance
/// between the lines of both edges (edge-edge). The closest points of vertex and plane, or of both lines,
/// then lie in the features iff all `outside` are at most 0, and strictly inside the features iff all
/// `outside` are negative.
struct Interiors {
  Polynomial F;
  Polynomial squared_N;
  std::vector<Polynomial> outside;
};
Interiors interiors(Kind kind, const std::array<PolynomialVector, 4>& x);

/// The statements about all pairs of features, for a finite b >= 0. The distance of the primitives at a time
/// is at most b iff one of the statements holds, and less than b iff one holds strictly.
class Nearness {
 public:
  Nearness(const Query& query, double b);

  [[nodiscard]] bool holds_at(Root& t) const;
  [[nodiscard]] bool holds_strictly_at(Root& t) const;

  /// Times in [0, 1], in no particular order and with repetitions: 0, and all times at which the sign of
  /// (distance - b) changes. So the earliest time at which the distance is at most b is one of these times.
  [[nodiscard]] std::vector<Root> candidates() const;

  [[nodiscard]] const std::vector<FeatureNearness>& statements() const { return statements_; }

 private:
  void add_vertices(const PolynomialVector& x, const PolynomialVector& y);
  void add_vertex_and_edge(const PolynomialVector& x, const PolynomialVector& from,
                           const PolynomialVector& to);
  void add_interiors(Interiors&& of);

  Polynomial squared_b_;
  std::vector<FeatureNearness> statements_;
};

/// Compares the smallest distance over [0, 1] exactly with any numbers.
class SmallestDistance {
 public:
  explicit SmallestDistance(const Query& query);

  /// Whether the smallest distance is at most `bound`, a finite number >= 0. Each call refines the stored
  /// roots, which makes later calls faster.
  [[nodiscard]] bool is_at_most(double bound);

 private:
  /// A pair of features. The squared distance of the lines or planes through the features is numerator /
  /// denominator. At each time in `times`, the closest points of these lines or planes lie in the features.
  struct Minima {
    Polynomial numerator, denominator;
    std::vector<Root> times;
  };

  Unit unit_;
  std::vector<Minima> minima_;
};

}  // namespace nearmiss::exact

namespace nearmiss {

/// Whether the smallest distance over [0, 1] is at most `bound`, a finite number >= 0. The answer is exact
/// for every finite query. `exact::SmallestDistance` answers several such questions in less time.
bool comes_within(const Query& query, double bound);

}  // namespace nearmiss
