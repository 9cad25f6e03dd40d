// The complete exact decision: signs of polynomials at real roots of polynomials.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "ccd/arithmetic.hpp"
#include "oracle/box.hpp"
#include "oracle/filter.hpp"
#include "oracle/first_contact.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

namespace exact {
namespace {

/// How the primitives meet at a time at which all four points are in one plane (see Predicates), if they do.
std::optional<Meeting> meet_at(Predicates& predicates, Root& t) {
  for (std::size_t k = 0; k < 3; ++k) {
    const int side = t.sign_of(predicates.N()[k]);
    if (side == 0) continue;
    Meeting meeting;
    for (const Polynomial& weight : predicates.weights(k)) {
      const int s = t.sign_of(weight);
      if (s == -side) return std::nullopt;
      meeting.vanishing_weights += s == 0 ? 1 : 0;
    }
    return meeting;
  }
  int vanishing_weights = 0;
  for (const OnSegment& on : predicates.segments()) {
    if (std::any_of(on.cross.begin(), on.cross.end(), [&](const Polynomial& c) { return t.sign_of(c) != 0; }))
      continue;
    const int beyond = t.sign_of(on.dot);  // zero at an end of the segment
    if (beyond <= 0) vanishing_weights = std::max(vanishing_weights, beyond == 0 ? 2 : 1);
  }
  if (vanishing_weights == 0) return std::nullopt;
  return Meeting{vanishing_weights, true};
}

/// The polynomials of whose roots in [0, 1] the earliest collision is one, if there is any, where F is zero
/// identically; or it is t = 0.
///
/// Where a component N_k of the normal is not zero identically they are N_k and its weights. For the set of
/// colliding times is closed, so it has a least element t*; were t* neither 0 nor a root of one of them that
/// is not identically zero, N_k would not be zero and none of them would change its sign in a neighbourhood
/// of t*, and there would be collisions before t*. Where N is zero identically, the same holds for what
/// decides about the segments. Of those with the same roots, as the three components of what stays in one
/// plane, one is enough.
std::vector<Polynomial> deciding_polynomials(Predicates& predicates) {
  std::vector<Polynomial> deciding;
  const auto add = [&](const Polynomial& p) {
    const auto same = [&](const Polynomial& q) { return are_proportional(p, q); };
    if (p.degree() > 0 && std::none_of(deciding.begin(), deciding.end(), same)) deciding.push_back(p);
  };
  for (std::size_t k = 0; k < 3; ++k) {
    if (predicates.N()[k].is_zero()) continue;
    add(predicates.N()[k]);
    for (const Polynomial& weight : predicates.weights(k)) add(weight);
    return deciding;
  }
  for (const OnSegment& on : predicates.segments()) {
    for (const Polynomial& c : on.cross) add(c);
    add(on.dot);
  }
  return deciding;
}

bool any_collision(const Query& query) {
  Predicates predicates(query);
  const auto meet = [&](Root& t) { return meet_at(predicates, t).has_value(); };
  const auto meet_at_a_root = [&](const Polynomial& p) { return holds_at_a_root(p, meet); };
  const Polynomial& F = predicates.F();
  if (!F.is_zero()) return meet_at_a_root(F);  // only there are the points in one plane
  Root start{Number(0)};
  if (meet(start)) return true;
  const auto deciding = deciding_polynomials(predicates);
  return std::any_of(deciding.begin(), deciding.end(), meet_at_a_root);
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

std::optional<FirstContact> first_contact(Predicates& predicates) {
  const Polynomial& F = predicates.F();
  if (!F.is_zero()) {
    for (Root& t : roots_in_step(F))
      if (const auto meeting = meet_at(predicates, t)) return FirstContact{t, *meeting};
    return std::nullopt;
  }
  Root start{Number(0)};
  if (const auto meeting = meet_at(predicates, start)) return FirstContact{start, *meeting};
  std::optional<FirstContact> first;
  for (const Polynomial& p : deciding_polynomials(predicates)) {
    if (first && OnInterval(p, 0, first->time.hi()).changes() == 0) continue;  // no root before
    for (Root& t : roots_in_step(p)) {
      if (first && !t.is_below(first->time)) break;
      const auto meeting = meet_at(predicates, t);
      if (!meeting) continue;
      first = {t, *meeting};
      break;
    }
  }
  return first;
}

}  // namespace exact

bool collides_exactly(const Query& query) {
  const PlainArithmetic guard;
  return exact::any_collision(query);
}

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
  const PlainArithmetic guard;
  if (!boxes_meet(query)) return std::nullopt;
  if (const FilterStage stage = filter(query); stage != FilterStage::undecided && !is_collision(stage))
    return std::nullopt;
  exact::Predicates predicates(query);
  auto contact = exact::first_contact(predicates);
  if (!contact) return std::nullopt;
  return ContactTime{exact::enclose(contact->time, width), exact::to_text(contact->time.as_rational())};
}

}  // namespace nearmiss
