// The complete exact decision: real algebraic times and signs of polynomials at them.
#include <CGAL/Gmpq.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "oracle/box.hpp"
#include "oracle/filter.hpp"
#include "oracle/oracle.hpp"
#include "oracle/predicates.hpp"

namespace nearmiss {

namespace exact {
namespace {

using Time = Kernel::Algebraic_real_1;
using Rational = Kernel::Bound;

bool is_zero(const Polynomial& p) { return CGAL::is_zero(p); }

CGAL::Sign sign_at(const Polynomial& p, const Time& t) {
  if (is_zero(p)) return CGAL::ZERO;
  return Kernel().sign_at_1_object()(p, t);
}

/// Whether the figures meet at a time at which all four points are in one plane (see Predicates).
bool meet_at(const Predicates& predicates, const Time& t) {
  for (std::size_t k = 0; k < 3; ++k) {
    const CGAL::Sign side = sign_at(predicates.N[k], t);
    if (side == CGAL::ZERO) continue;
    return std::all_of(predicates.weights.begin(), predicates.weights.end(),
                       [&](const Vector& weight) { return sign_at(weight[k], t) != -side; });
  }
  return std::any_of(predicates.segments.begin(), predicates.segments.end(), [&](const OnSegment& on) {
    return std::all_of(on.cross.begin(), on.cross.end(),
                       [&](const Polynomial& c) { return sign_at(c, t) == CGAL::ZERO; }) &&
           sign_at(on.dot, t) != CGAL::POSITIVE;
  });
}

/// Adds the roots of p in [0, 1], ascending; none where p is constant.
void add_roots(const Polynomial& p, std::vector<Time>& times) {
  if (is_zero(p) || p.degree() == 0) return;
  std::vector<Time> roots;
  Kernel().solve_1_object()(p, false, std::back_inserter(roots));
  for (const Time& root : roots)
    if (root >= Time(0) && root <= Time(1)) times.push_back(root);
}

/// Whether F has one sign on [0, 1] because its Bernstein coefficients (times 3) have: an exact and cheap
/// reason for there being no root.
bool one_sign(const Polynomial& F) {
  const auto f = [&](int i) { return i <= F.degree() ? F[static_cast<unsigned>(i)] : Integer(0); };
  const Integer b0 = 3 * f(0);
  const Integer b1 = b0 + f(1);
  const Integer b2 = b1 + f(1) + f(2);
  const Integer b3 = 3 * (f(0) + f(1) + f(2) + f(3));
  const auto s = CGAL::sign(b0);
  return s != CGAL::ZERO && CGAL::sign(b1) == s && CGAL::sign(b2) == s && CGAL::sign(b3) == s;
}

/// The polynomials of whose roots in [0, 1] the earliest collision is one, if there is any; or it is t = 0.
///
/// Where F is not identically zero it is F alone: only then are the points coplanar. Where it is, they are all
/// predicate polynomials. For the set of colliding times is closed, so it has a least element t*; were t*
/// neither 0 nor a root of a predicate that is not identically zero, no predicate would change its sign in a
/// neighbourhood of t*, and there would be collisions before t*.
std::vector<const Polynomial*> deciding_polynomials(const Predicates& predicates) {
  if (!is_zero(predicates.F)) {
    if (one_sign(predicates.F)) return {};
    return {&predicates.F};
  }
  std::vector<const Polynomial*> deciding;
  const auto add = [&](const Vector& v) {
    for (const Polynomial& p : v) deciding.push_back(&p);
  };
  add(predicates.N);
  for (const Vector& weight : predicates.weights) add(weight);
  for (const OnSegment& on : predicates.segments) {
    add(on.cross);
    deciding.push_back(&on.dot);
  }
  return deciding;
}

/// Whether there is a collision at all: t = 0 first, then the roots of one polynomial after the other.
bool any_collision(const Query& query) {
  const Predicates predicates(query);
  if (is_zero(predicates.F) && meet_at(predicates, Time(0))) return true;
  const auto deciding = deciding_polynomials(predicates);
  return std::any_of(deciding.begin(), deciding.end(), [&](const Polynomial* p) {
    std::vector<Time> roots;
    add_roots(*p, roots);
    return std::any_of(roots.begin(), roots.end(), [&](const Time& t) { return meet_at(predicates, t); });
  });
}

std::optional<Time> first_collision(const Query& query) {
  const Predicates predicates(query);
  std::vector<Time> times;
  if (is_zero(predicates.F)) times.emplace_back(0);
  for (const Polynomial* p : deciding_polynomials(predicates)) add_roots(*p, times);
  std::sort(times.begin(), times.end());
  for (const Time& t : times)
    if (meet_at(predicates, t)) return t;
  return std::nullopt;
}

/// Doubles around a time in [0, 1], at most 2^-52 apart; the time itself where it is a double.
Enclosure enclose(const Time& t) {
  constexpr int bits = 64;
  const auto [lo, hi] = Kernel().approximate_absolute_1_object()(t, bits);
  const double middle = CGAL::to_double((lo + hi) / 2);
  if (Kernel().compare_1_object()(t, Rational(middle)) == CGAL::EQUAL) return {middle, middle};
  // Both ends of the dyadic interval are rounded outward by at most 2^-53.
  return {std::max(0.0, CGAL::to_interval(lo).first), std::min(1.0, CGAL::to_interval(hi).second)};
}

}  // namespace
}  // namespace exact

bool collides_exactly(const Query& query) { return exact::any_collision(query); }

Decision decide(const Query& query) {
  if (!boxes_meet(query)) return {false, FilterStage::boxes};
  const FilterStage stage = filter(query);
  return {stage == FilterStage::undecided ? collides_exactly(query) : is_collision(stage), stage};
}

void decide(std::span<const Query> queries, std::span<Decision> decisions) {
  std::vector<FilterStage> stages(queries.size());
  filter(queries, stages);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const FilterStage stage = boxes_meet(queries[i]) ? stages[i] : FilterStage::boxes;
    decisions[i] = {stage == FilterStage::undecided ? collides_exactly(queries[i]) : is_collision(stage),
                    stage};
  }
}

bool collides(const Query& query) { return decide(query).collision; }

std::optional<Enclosure> earliest_time(const Query& query) {
  if (!boxes_meet(query)) return std::nullopt;
  const auto t = exact::first_collision(query);
  if (!t) return std::nullopt;
  return exact::enclose(*t);
}

}  // namespace nearmiss
