// Every first contact is at a root of F, the coplanarity cubic, or, if F is identically zero, at t = 0 or at
// a root of one of deciding_polynomials(). At each of these times, signs of polynomials decide whether the
// primitives meet.
#include "oracle/exact/first_contact.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace nearmiss::exact {

namespace {

/// How the primitives meet at a time at which all four points are in one plane (see Predicates); nothing if
/// they do not meet.
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
    const int beyond = t.sign_of(on.dot);  // 0 if the vertex is at an end of the segment
    if (beyond <= 0) vanishing_weights = std::max(vanishing_weights, beyond == 0 ? 2 : 1);
  }
  if (vanishing_weights == 0) return std::nullopt;
  return Meeting{vanishing_weights, true};
}

/// Polynomials for the case that F is identically zero. If there is a collision, the earliest one is at t = 0
/// or at a root of one of these polynomials in [0, 1].
///
/// If a component N_k of the normal is not identically zero, the polynomials are N_k and component k of each
/// weight. Proof: the set of colliding times is closed, so it has a least element t*. Suppose that t* is
/// neither 0 nor a root of one of the polynomials that are not identically zero. Then N_k is not zero and no
/// polynomial changes its sign in a neighbourhood of t*, so there are collisions before t*, a contradiction.
/// If N is identically zero, the polynomials are those of Predicates::segments(), for the same reason. If
/// several of these polynomials are proportional to each other, as the components of a vector of constant
/// direction are, one of them is enough.
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
    if (first && OnInterval(p, 0, first->time.hi()).changes() == 0) continue;  // no root before `first`
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

Collision any_collision(const Query& query) {
  Predicates predicates(query);
  if (!predicates.F().is_zero()) {
    auto contact = first_contact(predicates);
    return contact ? Collision{true, std::move(contact->time)} : Collision{};
  }
  const auto meet = [&](Root& t) { return meet_at(predicates, t).has_value(); };
  Root start{Number(0)};
  if (meet(start)) return {true, start};
  const auto deciding = deciding_polynomials(predicates);
  return {std::any_of(deciding.begin(), deciding.end(),
                      [&](const Polynomial& p) { return holds_at_a_root(p, meet); })};
}

}  // namespace nearmiss::exact
