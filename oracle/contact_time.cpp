#include "oracle/contact_time.hpp"

#include <gmpxx.h>

#include <cmath>
#include <stdexcept>

#include "ccd/arithmetic.hpp"
#include "oracle/exact/first_contact.hpp"
#include "oracle/filter/filter.hpp"

namespace nearmiss {

namespace {

using exact::Number;
using exact::Root;

/// The largest double that is not above x, for x in [0, 1].
double rounded_down(const Number& x) {
  double d = CGAL::to_double(x);
  while (Number(d) > x) d = std::nextafter(d, -1.0);
  while (Number(std::nextafter(d, 2.0)) <= x) d = std::nextafter(d, 2.0);
  return d;
}

/// Two doubles that enclose a time in [0, 1], at most `width` apart or as near as doubles allow; both are the
/// time itself if it is a double.
Enclosure enclose(Root& t, double width) {
  for (;; t.refine()) {
    const double lo = rounded_down(t.lo());
    const double last = rounded_down(t.hi());
    const double hi = Number(last) < t.hi() ? std::nextafter(last, 2.0) : last;
    const double next = std::nextafter(lo, 2.0);
    if (std::nextafter(next, 2.0) < hi && hi - lo > width) continue;  // a double is left between them
    for (const double each : {lo, next, hi})
      if (t.is(Number(each))) return {each, each};
    if (next >= hi || hi - lo <= width) return {lo, hi};
  }
}

}  // namespace

ContactTime::ContactTime(const Query& query) : query_(query) {
  const auto time = time_of_contact(query);
  if (!time) throw std::invalid_argument("expected a query with a contact");
  known_ = *time;
}

ContactTime::~ContactTime() = default;
ContactTime::ContactTime(ContactTime&&) noexcept = default;
ContactTime& ContactTime::operator=(ContactTime&&) noexcept = default;

bool ContactTime::is_before(double time) {
  if (!(time > known_.lo)) return false;
  if (time > known_.hi) return true;
  const PlainArithmetic guard;
  Root at{Number(time)};
  return root().is_below(at);
}

const Enclosure& ContactTime::enclosure(double width) {
  if (known_.lo != known_.hi && (width == 0 || known_.hi - known_.lo > width)) {
    const PlainArithmetic guard;
    known_ = enclose(root(), width);
  }
  return known_;
}

std::string ContactTime::rational() {
  const PlainArithmetic guard;
  const auto rational = root().as_rational();
  return rational ? mpq_class(rational->mpq()).get_str() : "";
}

exact::Root& ContactTime::root() {
  if (!root_) {
    exact::Predicates predicates(query_);
    auto contact = exact::first_contact(predicates);
    if (!contact) throw std::invalid_argument("expected a query with a contact");
    root_ = std::make_unique<Root>(std::move(contact->time));
  }
  return *root_;
}

}  // namespace nearmiss
