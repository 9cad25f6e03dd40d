// A pair of features, such as a vertex and an edge, is described by polynomials in t: `excess`, a positive multiple of
// distance² - h² of the lines or planes through them; `inside`, none of which is negative where the closest points of these
// lie in the features; and `extent`, which is positive unless the features are degenerate. At every time, the closest
// points of the primitives are those of such a pair, or of a vertex of each.
//
// The distance is at most h at some time iff it is at t = 0, or at a root of the excess of a pair or, if that is identically
// 0, of one of its `inside`: at the first such time, the pair's conditions begin to hold.
//
// The distance is below h at some time iff it is so in an open interval, where one pair has the closest points, and none of
// its polynomials changes its sign. Such an interval of greatest length begins at 0 or at a root of one of them. So it is
// enough to know the signs right behind 0 and behind these roots: of the first derivative that is not 0 there.
#include "oracle/sturm/separation.hpp"

#include <algorithm>
#include <vector>

#include "ccd/arithmetic.hpp"
#include "oracle/sturm/primitives.hpp"

namespace nearmiss {

namespace sturm {
namespace {

struct FeaturePair {
  IntegerPolynomial excess;
  std::vector<IntegerPolynomial> inside;
  IntegerPolynomial extent;
};

/// The sign of p right behind t.
int sign_behind(IntegerPolynomial p, const SturmRoot& t) {
  int sign = t.sign(p);
  for (; sign == 0 && !p.is_zero(); sign = t.sign(p)) p = p.derivative();
  return sign;
}

class FeaturePairs {
 public:
  explicit FeaturePairs(Primitives& primitives) : primitives_(primitives) {
    const Integer& h = primitives.separation();
    squared_separation_ = IntegerPolynomial({h * h});
    if (primitives.kind() == Kind::vertex_triangle) {
      for (std::size_t i = 1; i < 4; ++i) {
        add_vertices(0, i);
        add_vertex_and_edge(0, i, i % 3 + 1);
      }
    } else {
      for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t j = 2; j < 4; ++j) add_vertices(i, j);
        add_vertex_and_edge(i, 2, 3);
        add_vertex_and_edge(i + 2, 0, 1);
      }
    }
    const IntegerPolynomial& area = primitives.area();
    pairs_.push_back(
        {primitives.F() * primitives.F() - squared_separation_ * area, primitives.weights(), area});
  }

  [[nodiscard]] const std::vector<FeaturePair>& all() const { return pairs_; }

 private:
  void add_vertices(std::size_t i, std::size_t j) {
    const IntegerPolynomialVector d = primitives_.x(i) - primitives_.x(j);
    pairs_.push_back({dot(d, d) - squared_separation_, {}, IntegerPolynomial({1})});
  }

  /// The squared distance of a point from a line, times the squared length e·e, is d·d e·e - (d·e)².
  void add_vertex_and_edge(std::size_t vertex, std::size_t from, std::size_t to) {
    const IntegerPolynomialVector d = primitives_.x(vertex) - primitives_.x(from);
    const IntegerPolynomialVector e = primitives_.x(to) - primitives_.x(from);
    const IntegerPolynomial along = dot(d, e);
    const IntegerPolynomial length = dot(e, e);
    pairs_.push_back(
        {(dot(d, d) - squared_separation_) * length - along * along, {along, length - along}, length});
  }

  Primitives& primitives_;
  IntegerPolynomial squared_separation_;
  std::vector<FeaturePair> pairs_;
};

bool is_at_most_at(const std::vector<FeaturePair>& pairs, const SturmRoot& t) {
  return std::any_of(pairs.begin(), pairs.end(), [&](const FeaturePair& pair) {
    return t.sign(pair.excess) <= 0 && t.sign(pair.extent) > 0 &&
           std::all_of(pair.inside.begin(), pair.inside.end(),
                       [&](const IntegerPolynomial& p) { return t.sign(p) >= 0; });
  });
}

bool is_below_behind(const FeaturePair& pair, const SturmRoot& t) {
  return sign_behind(pair.excess, t) < 0 && sign_behind(pair.extent, t) > 0 &&
         std::all_of(pair.inside.begin(), pair.inside.end(),
                     [&](const IntegerPolynomial& p) { return sign_behind(p, t) >= 0; });
}

/// Whether holds(t) is true for a root t of p in [0, 1]; false if p is identically 0.
template <class Holds>
bool any_root(const IntegerPolynomial& p, const Holds& holds) {
  if (p.is_zero()) return false;
  const auto roots = roots_in_unit_interval(p);
  return std::any_of(roots.begin(), roots.end(), holds);
}

template <class Holds>
bool any_root(const std::vector<IntegerPolynomial>& all, const Holds& holds) {
  return std::any_of(all.begin(), all.end(), [&](const IntegerPolynomial& p) { return any_root(p, holds); });
}

/// Whether the distance is at most h at a time t for which `counts` is true, and whether it is below h right behind one.
template <class Counts>
Reach reach_where(const Query& query, const Counts& counts) {
  const PlainArithmetic guard;
  Primitives primitives(query);
  const std::vector<FeaturePair> pairs = FeaturePairs(primitives).all();
  const SturmRoot start(Dyadic{0, 0});
  const IntegerPolynomial after_step = after(1);
  Reach found;
  for (const FeaturePair& pair : pairs) {
    if (start.sign(pair.excess) > 0 && !any_root(pair.excess, counts)) continue;  // always farther apart
    const auto is_below = [&](const SturmRoot& t) {
      return counts(t) && t.sign(after_step) < 0 && is_below_behind(pair, t);
    };
    if (is_below(start) || any_root(pair.excess, is_below) || any_root(pair.inside, is_below))
      return {true, true};
    if (found.at_most) continue;
    const auto is_at_most = [&](const SturmRoot& t) { return counts(t) && is_at_most_at(pairs, t); };
    found.at_most = is_at_most(start) || (pair.excess.is_zero() ? any_root(pair.inside, is_at_most)
                                                                : any_root(pair.excess, is_at_most));
  }
  return found;
}

}  // namespace
}  // namespace sturm

Reach reach(const Query& query) {
  return sturm::reach_where(query, [](const sturm::SturmRoot& /*t*/) { return true; });
}

Reach reach_before(const Query& query, double time) {
  const sturm::IntegerPolynomial after_time = sturm::after(time);
  return sturm::reach_where(query, [&](const sturm::SturmRoot& t) { return t.sign(after_time) < 0; });
}

}  // namespace nearmiss
