#include "oracle/sturm/sturm.hpp"

#include <algorithm>
#include <vector>

#include "ccd/arithmetic.hpp"
#include "oracle/sturm/primitives.hpp"

namespace nearmiss {

namespace sturm {
namespace {

enum class ContactPlace { none, inside, at_border };

ContactPlace contact_at(Primitives& primitives, const SturmRoot& t) {
  if (t.sign(primitives.area()) > 0) {
    int least = 1;
    for (const IntegerPolynomial& weight : primitives.weights()) {
      least = std::min(least, t.sign(weight));
      if (least < 0) return ContactPlace::none;
    }
    return least > 0 && !t.is_end() ? ContactPlace::inside : ContactPlace::at_border;
  }
  const bool any = std::any_of(
      primitives.segments().begin(), primitives.segments().end(),
      [&](const SegmentMembership& on) { return t.sign(on.off_line) == 0 && t.sign(on.beyond) <= 0; });
  return any ? ContactPlace::at_border : ContactPlace::none;
}

/// The multiplicity of the root t of F.
int multiplicity(const IntegerPolynomial& F, const SturmRoot& t) {
  int m = 1;
  for (IntegerPolynomial d = F.derivative(); !d.is_zero() && t.sign(d) == 0; d = d.derivative()) ++m;
  return m;
}

/// The times of which the first contact is one, if there is a contact: the roots of F. If F is identically zero, the set of
/// colliding times is closed, and its least element is 0 or a root of one of the polynomials whose signs decide. Calls
/// `holds` with each of these times until it returns true; returns whether it did.
template <class Holds>
bool any_candidate(Primitives& primitives, const Holds& holds) {
  const auto any_root = [&](const IntegerPolynomial& p) {
    const auto roots = roots_in_unit_interval(p);
    return std::any_of(roots.begin(), roots.end(), holds);
  };
  if (!primitives.F().is_zero()) return any_root(primitives.F());
  std::vector<const IntegerPolynomial*> deciding{&primitives.area()};
  for (const IntegerPolynomial& weight : primitives.weights()) deciding.push_back(&weight);
  for (const SegmentMembership& on : primitives.segments()) {
    deciding.push_back(&on.off_line);
    deciding.push_back(&on.beyond);
  }
  return holds(SturmRoot(Dyadic{0, 0})) ||
         std::any_of(deciding.begin(), deciding.end(),
                     [&](const IntegerPolynomial* p) { return !p->is_zero() && any_root(*p); });
}

}  // namespace
}  // namespace sturm

RootCount count_roots(const Query& query) {
  using namespace sturm;
  const PlainArithmetic guard;
  Primitives primitives(query);
  RootCount count;
  if (primitives.F().is_zero()) {
    count.planar = true;
    count.collision = any_candidate(
        primitives, [&](const SturmRoot& t) { return contact_at(primitives, t) != ContactPlace::none; });
    count.on_boundary = count.collision;
    return count;
  }
  for (const SturmRoot& t : roots_in_unit_interval(primitives.F())) {
    const ContactPlace place = contact_at(primitives, t);
    if (place == ContactPlace::none) continue;
    count.collision = true;
    count.on_boundary |= place == ContactPlace::at_border;
    ++count.distinct;
    count.with_multiplicity += multiplicity(primitives.F(), t);
  }
  return count;
}

bool meet_before(const Query& query, double time) {
  using namespace sturm;
  const PlainArithmetic guard;
  Primitives primitives(query);
  const IntegerPolynomial after_time = after(time);
  return any_candidate(primitives, [&](const SturmRoot& t) {
    return t.sign(after_time) < 0 && contact_at(primitives, t) != ContactPlace::none;
  });
}

}  // namespace nearmiss
