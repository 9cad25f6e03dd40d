// The complete exact decision: signs of polynomials at real roots of polynomials.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "oracle/box.hpp"
#include "oracle/filter.hpp"
#include "oracle/oracle.hpp"
#include "oracle/predicates.hpp"
#include "oracle/root.hpp"

namespace nearmiss {

namespace exact {
namespace {

/// Whether the figures meet at a time at which all four points are in one plane (see Predicates).
bool meet_at(const Predicates& predicates, Root& t) {
  for (std::size_t k = 0; k < 3; ++k) {
    const int side = t.sign_of(predicates.N(k));
    if (side == 0) continue;
    const auto weights = predicates.weights(k);
    return std::all_of(weights.begin(), weights.end(),
                       [&](const Polynomial& weight) { return t.sign_of(weight) != -side; });
  }
  const auto segments = predicates.segments();
  return std::any_of(segments.begin(), segments.end(), [&](const OnSegment& on) {
    return std::all_of(on.cross.begin(), on.cross.end(),
                       [&](const Polynomial& c) { return t.sign_of(c) == 0; }) &&
           t.sign_of(on.dot) <= 0;
  });
}

/// The polynomials of whose roots in [0, 1] the earliest collision is one, if there is any, where F is zero
/// identically; or it is t = 0.
///
/// They are all predicate polynomials. For the set of colliding times is closed, so it has a least element
/// t*; were t* neither 0 nor a root of a predicate that is not identically zero, no predicate would change
/// its sign in a neighbourhood of t*, and there would be collisions before t*.
std::vector<Polynomial> deciding_polynomials(const Predicates& predicates) {
  std::vector<Polynomial> deciding;
  for (std::size_t k = 0; k < 3; ++k) {
    deciding.push_back(predicates.N(k));
    for (Polynomial& weight : predicates.weights(k)) deciding.push_back(std::move(weight));
  }
  for (OnSegment& on : predicates.segments()) {
    for (Polynomial& c : on.cross) deciding.push_back(std::move(c));
    deciding.push_back(std::move(on.dot));
  }
  return deciding;
}

bool any_collision(const Query& query) {
  const Predicates predicates(query);
  const auto meet = [&](Root& t) { return meet_at(predicates, t); };
  const auto meet_at_a_root = [&](const Polynomial& p) { return holds_at_a_root(p, meet); };
  const Polynomial F = predicates.F();
  if (!F.is_zero()) return meet_at_a_root(F);  // only there are the points in one plane
  Root start{Number(0)};
  if (meet(start)) return true;
  const auto deciding = deciding_polynomials(predicates);
  return std::any_of(deciding.begin(), deciding.end(), meet_at_a_root);
}

std::optional<Root> first_collision(const Query& query) {
  const Predicates predicates(query);
  const Polynomial F = predicates.F();
  if (!F.is_zero()) {
    for (Root& t : roots_in_step(F))
      if (meet_at(predicates, t)) return t;
    return std::nullopt;
  }
  std::optional<Root> first;
  if (Root start{Number(0)}; meet_at(predicates, start)) return start;
  for (const Polynomial& p : deciding_polynomials(predicates))
    for (Root& t : roots_in_step(p)) {
      if (first && !t.is_below(*first)) break;
      if (!meet_at(predicates, t)) continue;
      first = t;
      break;
    }
  return first;
}

/// The largest double that is not above x, x in [0, 1].
double rounded_down(const Number& x) {
  double d = CGAL::to_double(x);
  while (Number(d) > x) d = std::nextafter(d, -1.0);
  while (Number(std::nextafter(d, 2.0)) <= x) d = std::nextafter(d, 2.0);
  return d;
}

/// Doubles around a time in [0, 1], at most `width` apart or as near as there are; the time itself where it
/// is a double.
Enclosure enclose(Root t, double width) {
  for (;; t.refine()) {
    const double lo = rounded_down(t.lo());
    const double last = rounded_down(t.hi());
    const double hi = Number(last) < t.hi() ? std::nextafter(last, 2.0) : last;
    const double next = std::nextafter(lo, 2.0);
    if (std::nextafter(next, 2.0) < hi && hi - lo > width) continue;  // two doubles between them
    for (const double each : {lo, next, hi})
      if (t.is(Number(each))) return {each, each};
    if (next >= hi || hi - lo <= width) return {lo, hi};
  }
}

std::string to_text(const std::optional<CGAL::Gmpq>& rational) {
  if (!rational) return {};
  std::ostringstream text;
  text << rational->numerator();
  if (rational->denominator() != 1) text << '/' << rational->denominator();
  return text.str();
}

}  // namespace
}  // namespace exact

bool collides_exactly(const Query& query) { return exact::any_collision(query); }

bool settle(const Query& query, FilterStage stage) {
  return stage == FilterStage::undecided ? collides_exactly(query) : is_collision(stage);
}

Decision decide(const Query& query) {
  if (!boxes_meet(query)) return {false, FilterStage::boxes};
  const FilterStage stage = filter(query);
  return {settle(query, stage), stage};
}

void decide(std::span<const Query> queries, std::span<Decision> decisions) {
  std::vector<FilterStage> stages(queries.size());
  filter(queries, stages);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const FilterStage stage = boxes_meet(queries[i]) ? stages[i] : FilterStage::boxes;
    decisions[i] = {settle(queries[i], stage), stage};
  }
}

bool collides(const Query& query) { return decide(query).collision; }

std::optional<ContactTime> earliest_time(const Query& query, double width) {
  if (!boxes_meet(query)) return std::nullopt;
  if (const FilterStage stage = filter(query); stage != FilterStage::undecided && !is_collision(stage))
    return std::nullopt;
  auto t = exact::first_collision(query);
  if (!t) return std::nullopt;
  return ContactTime{exact::enclose(*t, width), exact::to_text(t->as_rational())};
}

}  // namespace nearmiss
