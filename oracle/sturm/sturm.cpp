#include "oracle/sturm/sturm.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "ccd/query/arithmetic.hpp"
#include "oracle/sturm/primitives.hpp"
#include "oracle/sturm/root.hpp"

namespace nearmiss {

namespace sturm {
namespace {

enum class ContactPlace { none, inside, at_border };

ContactPlace contact_at(Primitives& primitives, SturmRoot& t) {
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
int multiplicity(const IntegerPolynomial& F, SturmRoot& t) {
  int m = 1;
  for (IntegerPolynomial d = F.derivative(); !d.is_zero() && t.sign(d) == 0; d = d.derivative()) ++m;
  return m;
}

/// Times that include the first contact, if there is one: the roots of F. If F is identically zero, they are
/// 0 and the roots of the polynomials whose signs decide, because the set of colliding times is closed, and
/// its least element is one of these.
std::vector<SturmRoot> contact_candidates(Primitives& primitives) {
  if (!primitives.F().is_zero()) return roots_in_unit_interval(primitives.F());
  std::vector<const IntegerPolynomial*> deciding{&primitives.area()};
  for (const IntegerPolynomial& weight : primitives.weights()) deciding.push_back(&weight);
  for (const SegmentMembership& on : primitives.segments()) {
    deciding.push_back(&on.off_line);
    deciding.push_back(&on.beyond);
  }
  std::vector<SturmRoot> times{SturmRoot(Dyadic{0, 0})};
  for (const IntegerPolynomial* p : deciding)
    if (!p->is_zero())
      for (SturmRoot& t : roots_in_unit_interval(*p)) times.push_back(std::move(t));
  return times;
}

}  // namespace
}  // namespace sturm

RootCount count_roots(const Query& query) {
  using namespace sturm;
  const PlainArithmetic guard;
  Primitives primitives(query);
  RootCount count;
  count.planar = primitives.F().is_zero();
  for (SturmRoot& t : contact_candidates(primitives)) {
    const ContactPlace place = contact_at(primitives, t);
    if (place == ContactPlace::none) continue;
    count.collision = true;
    count.on_boundary |= count.planar || place == ContactPlace::at_border;
    if (count.planar) break;
    ++count.distinct;
    count.with_multiplicity += multiplicity(primitives.F(), t);
  }
  return count;
}

struct SturmContact::Candidates {
  struct Candidate {
    sturm::SturmRoot t;
    std::optional<bool> is_contact;
  };

  sturm::Primitives primitives;
  std::vector<Candidate> all;

  explicit Candidates(const Query& query) : primitives(query) {
    for (sturm::SturmRoot& t : sturm::contact_candidates(primitives)) all.push_back({std::move(t), {}});
  }

  bool is_contact(Candidate& at) {
    if (!at.is_contact) at.is_contact = sturm::contact_at(primitives, at.t) != sturm::ContactPlace::none;
    return *at.is_contact;
  }
};

SturmContact::SturmContact(const Query& query) {
  const PlainArithmetic guard;
  candidates_ = std::make_unique<Candidates>(query);
}

SturmContact::~SturmContact() = default;

bool SturmContact::is_before(double time) {
  const PlainArithmetic guard;
  const sturm::Dyadic end = sturm::to_dyadic(time);
  return std::any_of(candidates_->all.begin(), candidates_->all.end(), [&](Candidates::Candidate& each) {
    return each.t.is_below(end) && candidates_->is_contact(each);
  });
}

}  // namespace nearmiss
