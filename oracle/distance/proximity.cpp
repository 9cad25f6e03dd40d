// The closed-set argument. The distance at a time is at most b if and only if one of finitely many statements
// about a pair of features holds: a vertex of each, a vertex and an edge, the vertex and the triangle, or two
// edges. Each statement says that the closest points of the lines or planes through the two features lie in
// the features and are within b of each other. As a condition, some polynomials in t are not positive, and
// one is positive unless the features are degenerate (then another statement says the same). The statement of
// the closest pair holds, and if any statement holds, there are points within b.
//
// The set of times at which some statement holds is closed, because the distance is continuous. If it is not
// empty, it has a least element t*. Either t* = 0, or the distance is b at t* and larger before. In the
// second case, the polynomial "distance² - b²" of the closest pair (times a denominator) is zero at t*. So t*
// is one of its roots, or that polynomial is zero identically. If it is zero identically, the pair's
// statement holds at t* and not before, because another polynomial that must not be positive was positive
// before; then t* is a root of that polynomial. (A polynomial that must be positive and is positive at t* was
// also positive just before.)
#include "oracle/distance/proximity.hpp"

#include <algorithm>
#include <vector>

#include "oracle/exact/moving.hpp"
#include "oracle/exact/root.hpp"

namespace nearmiss {

namespace exact {
namespace {

/// The statement that two features come within b.
struct Nearness {
  Polynomial excess;                ///< (distance² - b²) times a positive factor; degree 6 at most
  std::vector<Polynomial> outside;  ///< all are at most 0 if the closest points lie in the features
  std::vector<Polynomial> extents;  ///< all are positive unless the features are degenerate

  [[nodiscard]] bool holds_at(Root& t) const {
    const auto is_in = [&](const Polynomial& p) { return t.sign_of(p) <= 0; };
    const auto is_extended = [&](const Polynomial& p) { return t.sign_of(p) > 0; };
    return is_in(excess) && std::all_of(outside.begin(), outside.end(), is_in) &&
           std::all_of(extents.begin(), extents.end(), is_extended);
  }
};

class FeaturePairs {
 public:
  FeaturePairs(const Query& query, double bound) {
    const Number scale = unit(query);
    const Number b = Number(bound) * scale;
    squared_bound_ = Polynomial({b * b});
    const auto x = moving_points(query, scale);
    if (query.kind == Kind::vertex_triangle) {
      for (std::size_t i = 1; i < 4; ++i) {
        add_vertices(x[0], x[i]);
        add_vertex_and_edge(x[0], x[i], x[i % 3 + 1]);
      }
      add_vertex_and_triangle(x);
    } else {
      for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t j = 2; j < 4; ++j) add_vertices(x[i], x[j]);
        add_vertex_and_edge(x[i], x[2], x[3]);
        add_vertex_and_edge(x[i + 2], x[0], x[1]);
      }
      add_edges(x);
    }
  }

  [[nodiscard]] const std::vector<Nearness>& statements() const { return statements_; }

 private:
  void add_vertices(const PolynomialVector& x, const PolynomialVector& y) {
    const PolynomialVector d = x - y;
    statements_.push_back({dot(d, d) - squared_bound_, {}, {}});
  }

  void add_vertex_and_edge(const PolynomialVector& x, const PolynomialVector& from,
                           const PolynomialVector& to) {
    const PolynomialVector d = x - from;
    const PolynomialVector e = to - from;
    const PolynomialVector area = cross(d, e);
    const Polynomial along = dot(d, e);
    const Polynomial length = dot(e, e);
    statements_.push_back(
        {dot(area, area) - squared_bound_ * length, {Polynomial() - along, along - length}, {length}});
  }

  /// Adds a statement for which the distance of the planes or lines is |F| / |N|.
  void add_with_normal(const Polynomial& F, const Polynomial& squared_N, std::vector<Polynomial> outside) {
    statements_.push_back({F * F - squared_bound_ * squared_N, std::move(outside), {squared_N}});
  }

  void add_vertex_and_triangle(const std::array<PolynomialVector, 4>& x) {
    const PolynomialVector N = cross(x[2] - x[1], x[3] - x[1]);
    std::vector<Polynomial> outside;
    for (std::size_t i = 1; i < 4; ++i) outside.push_back(dot(N, cross(x[0] - x[i], x[i % 3 + 1] - x[i])));
    add_with_normal(dot(x[0] - x[1], N), dot(N, N), std::move(outside));
  }

  void add_edges(const std::array<PolynomialVector, 4>& x) {
    const PolynomialVector u = x[1] - x[0];
    const PolynomialVector v = x[3] - x[2];
    const PolynomialVector x20 = x[2] - x[0];
    const PolynomialVector N = cross(u, v);
    const Polynomial whole = dot(N, N);  // α and β are the polynomials below divided by it
    const Polynomial alpha = dot(cross(x20, v), N);
    const Polynomial beta = dot(cross(x20, u), N);
    add_with_normal(dot(x20, N), whole,
                    {Polynomial() - alpha, alpha - whole, Polynomial() - beta, beta - whole});
  }

  Polynomial squared_bound_;
  std::vector<Nearness> statements_;
};

}  // namespace
}  // namespace exact

bool comes_within(const Query& query, double bound) {
  using namespace exact;
  const FeaturePairs pairs(query, bound);
  const auto is_near = [&](Root& t) {
    return std::any_of(pairs.statements().begin(), pairs.statements().end(),
                       [&](const Nearness& statement) { return statement.holds_at(t); });
  };
  if (Root start{Number(0)}; is_near(start)) return true;
  const auto is_near_at_a_root = [&](const Polynomial& p) { return holds_at_a_root(p, is_near); };
  return std::any_of(pairs.statements().begin(), pairs.statements().end(), [&](const Nearness& statement) {
    const Polynomial& excess = statement.excess;
    if (!excess.is_zero()) return is_near_at_a_root(excess);
    return std::any_of(statement.outside.begin(), statement.outside.end(), is_near_at_a_root);
  });
}

}  // namespace nearmiss
