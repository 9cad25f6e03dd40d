// A pair of features, such as a vertex and an edge, is described by polynomials in t:
// - `excess` is a positive multiple of d² - h², where d is the distance of the features after edges are
//   extended to lines, and triangles to planes.
// - None of `inside` is negative where the closest points of the extended features lie in the features
//   themselves.
// - `extent` is positive unless the features are degenerate.
// At every time, the closest points of the primitives are those of such a pair, or of a vertex of each.
//
// The distance is at most h at some time iff it is at most h at t = 0 or at a root of the excess of a pair
// or, if that excess is identically 0, at a root of one of the pair's `inside`. The reason is that the
// conditions of the closest pair begin to hold at the first such time.
//
// The distance is below h at some time iff it is below h in an open interval in which one pair has the
// closest points and none of its polynomials changes its sign. Such an interval of greatest length begins at
// 0 or at a root of one of these polynomials. So it is enough to know the signs right after 0 and right after
// these roots. Each is the sign of the first derivative that is not 0 there.
#include "oracle/sturm/separation.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "ccd/query/arithmetic.hpp"
#include "oracle/sturm/primitives.hpp"
#include "oracle/sturm/root.hpp"

namespace nearmiss {

namespace sturm {
namespace {

/// A time at which the conditions of a pair may begin to hold.
struct Candidate {
  SturmRoot t;
  const IntegerPolynomial* root_of = nullptr;  ///< a polynomial of the pair that is 0 at t, if one is known
  std::optional<bool> at_most;                 ///< whether the conditions hold at t
  std::optional<bool> below;                   ///< whether they hold strictly right after t

  int sign(const IntegerPolynomial& p) { return &p == root_of ? 0 : t.sign(p); }

  /// The sign of p right after t.
  int sign_behind(const IntegerPolynomial& p) {
    int found = sign(p);
    for (IntegerPolynomial d = p; found == 0 && !d.is_zero(); found = t.sign(d)) d = d.derivative();
    return found;
  }
};

class FeaturePair {
 public:
  FeaturePair(IntegerPolynomial excess, std::vector<IntegerPolynomial> inside, IntegerPolynomial extent)
      : excess_(std::move(excess)), inside_(std::move(inside)), extent_(std::move(extent)) {}

  bool is_at_most_before(const Dyadic& time) {
    const auto holds = [&](Candidate& each) { return each.t.is_below(time) && is_at_most_at(each); };
    return holds(start_) || any_of(excess_.is_zero() ? inside_roots() : excess_roots(), holds);
  }

  bool is_below_before(const Dyadic& time) {
    const auto counts = [&](const Candidate& each) { return each.t.is_below(time); };
    if (start_.sign(excess_) > 0 && !any_of(excess_roots(), counts)) return false;  // always farther apart
    const auto holds = [&](Candidate& each) { return counts(each) && is_below_behind(each); };
    return holds(start_) || any_of(excess_roots(), holds) || any_of(inside_roots(), holds);
  }

 private:
  using Candidates = std::vector<Candidate>;

  template <class Holds>
  static bool any_of(Candidates& candidates, const Holds& holds) {
    return std::any_of(candidates.begin(), candidates.end(), holds);
  }

  bool is_at_most_at(Candidate& at) {
    if (!at.at_most)
      at.at_most = at.sign(excess_) <= 0 && at.sign(extent_) > 0 &&
                   std::all_of(inside_.begin(), inside_.end(),
                               [&](const IntegerPolynomial& p) { return at.sign(p) >= 0; });
    return *at.at_most;
  }

  bool is_below_behind(Candidate& at) {
    if (!at.below)
      at.below = at.t.is_below({1, 0}) && at.sign_behind(excess_) < 0 && at.sign_behind(extent_) > 0 &&
                 std::all_of(inside_.begin(), inside_.end(),
                             [&](const IntegerPolynomial& p) { return at.sign_behind(p) >= 0; });
    return *at.below;
  }

  static void add_roots(const IntegerPolynomial& p, Candidates& candidates) {
    if (p.is_zero()) return;
    for (SturmRoot& t : roots_in_unit_interval(p)) candidates.push_back({std::move(t), &p, {}, {}});
  }

  Candidates& excess_roots() {
    if (!excess_roots_) add_roots(excess_, excess_roots_.emplace());
    return *excess_roots_;
  }

  Candidates& inside_roots() {
    if (!inside_roots_) {
      inside_roots_.emplace();
      for (const IntegerPolynomial& p : inside_) add_roots(p, *inside_roots_);
    }
    return *inside_roots_;
  }

  IntegerPolynomial excess_;
  std::vector<IntegerPolynomial> inside_;
  IntegerPolynomial extent_;
  Candidate start_{SturmRoot(Dyadic{0, 0}), nullptr, {}, {}};
  std::optional<Candidates> excess_roots_, inside_roots_;  // with pointers to the polynomials above
};

class FeaturePairs {
 public:
  explicit FeaturePairs(const Query& query) : primitives_(query) {
    const Integer& h = primitives_.separation();
    squared_separation_ = IntegerPolynomial({h * h});
    const Topology& of = topology(query.kind);
    for (const VertexPair gap : of.gaps) add_vertices(gap.from, gap.to);
    for (const auto& [vertex, from, to] : of.vertices_and_edges) add_vertex_and_edge(vertex, from, to);
    const IntegerPolynomial& area = primitives_.area();
    all.emplace_back(primitives_.F() * primitives_.F() - squared_separation_ * area, primitives_.weights(),
                     area);
  }

  std::vector<FeaturePair> all;

 private:
  void add_vertices(std::size_t i, std::size_t j) {
    const IntegerPolynomialVector d = primitives_.x(i) - primitives_.x(j);
    all.emplace_back(dot(d, d) - squared_separation_, std::vector<IntegerPolynomial>(),
                     IntegerPolynomial({1}));
  }

  /// The squared distance of a point from a line, times the squared length e·e, is d·d e·e - (d·e)².
  void add_vertex_and_edge(std::size_t vertex, std::size_t from, std::size_t to) {
    const IntegerPolynomialVector d = primitives_.x(vertex) - primitives_.x(from);
    const IntegerPolynomialVector e = primitives_.x(to) - primitives_.x(from);
    const IntegerPolynomial along = dot(d, e);
    const IntegerPolynomial length = dot(e, e);
    all.emplace_back((dot(d, d) - squared_separation_) * length - along * along,
                     std::vector{along, length - along}, length);
  }

  Primitives primitives_;
  IntegerPolynomial squared_separation_;
};

template <class Holds>
bool any_pair(std::vector<FeaturePair>& pairs, const Holds& holds) {
  return std::any_of(pairs.begin(), pairs.end(), holds);
}

}  // namespace
}  // namespace sturm

struct SturmApproach::Pairs {
  std::vector<sturm::FeaturePair> all;
};

SturmApproach::SturmApproach(const Query& query) {
  const PlainArithmetic guard;
  pairs_.reset(new Pairs{sturm::FeaturePairs(query).all});
}

SturmApproach::~SturmApproach() = default;

bool SturmApproach::is_at_most_before(double time) {
  const PlainArithmetic guard;
  const sturm::Dyadic end = sturm::to_dyadic(time);
  return sturm::any_pair(pairs_->all, [&](sturm::FeaturePair& pair) { return pair.is_at_most_before(end); });
}

bool SturmApproach::is_below_before(double time) {
  const PlainArithmetic guard;
  const sturm::Dyadic end = sturm::to_dyadic(time);
  return sturm::any_pair(pairs_->all, [&](sturm::FeaturePair& pair) { return pair.is_below_before(end); });
}

}  // namespace nearmiss
