#include "oracle/earliest_time.hpp"

#include <gmpxx.h>

#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "ccd/query/arithmetic.hpp"
#include "oracle/distance/crossing.hpp"
#include "oracle/exact/first_approach.hpp"
#include "oracle/exact/first_contact.hpp"
#include "oracle/filter/filter.hpp"
#include "oracle/within_separation.hpp"

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

/// Two doubles that enclose a time in [0, 1]. They are at most `width` apart, or as near to each other as
/// doubles allow. If `width` is 0 and the time is a double, both are the time itself.
Enclosure enclose(Root t, double width) {
  for (;; t.refine()) {
    const double lo = rounded_down(t.lo());
    const double last = rounded_down(t.hi());
    const double hi = Number(last) < t.hi() ? std::nextafter(last, 2.0) : last;
    const double next = std::nextafter(lo, 2.0);
    // The root is refined further if more than one double lies between lo and hi, and lo and hi are more than
    // `width` apart.
    if (std::nextafter(next, 2.0) < hi && hi - lo > width) continue;
    for (const double each : {lo, next, hi})
      if (t.is(Number(each))) return {each, each};
    if (next >= hi || hi - lo <= width) return {lo, hi};
  }
}

// Comparing a root with a number may refine the interval of the root. The functions below compare copies of
// roots, so that an answer does not depend on earlier questions.
bool is_below(Root t, double time) {
  Root at{Number(time)};
  return t.is_below(at);
}

[[noreturn]] void refuse() {
  throw std::invalid_argument("expected primitives that come within the separation");
}

exact::FirstApproach first_approach(const Query& query) {
  auto approach = exact::first_approach(query);
  if (!approach) refuse();
  return *std::move(approach);
}

/// The first contact, as a root of F, the coplanarity cubic. If `known.is_between`, certified bounds have
/// shown that F changes its sign in the enclosure, and that every root of F in it is a contact. So if F has
/// only one root in the enclosure, this root is the first contact.
Root first_root(const Query& query, const KnownTime& known) {
  exact::Predicates predicates(query);
  if (known.is_between) {
    const Number lo = known.time.lo;
    const Number hi = known.time.hi;
    const exact::Polynomial& F = predicates.F();
    if (exact::OnInterval(F, lo, hi).changes() == 1 && F.sign_at(lo) != 0 && F.sign_at(hi) != 0)
      return Root(std::make_shared<const exact::Polynomial>(F), lo, hi);
  }
  auto contact = exact::first_contact(predicates);
  if (!contact) refuse();
  return contact->time;
}

/// An enclosure of t*. If `is_certified` is true and the enclosure does not begin at 0, certified bounds show
/// that the distance is above h at the beginning of the enclosure, and below h at the end. So t* is neither
/// of these two times.
KnownTime between(const Enclosure& time, bool is_certified) { return {time, is_certified && time.lo > 0}; }

/// 1 if all numbers in the enclosure `known` of t* are below `time`, 0 if none is, -1 if only some are.
int comparison(const Enclosure& known, double time) {
  if (!(time > known.lo)) return 0;
  return time > known.hi ? 1 : -1;
}

}  // namespace

EarliestTime::EarliestTime(const Query& query, const KnownTimes& known)
    : query_(query), exact_(known.exactly) {
  const PlainArithmetic guard;
  if (query.separation > 0) {
    const KnownApproach approach =
        narrowed(query, known.approach ? *known.approach : known_approach(query), rough_time);
    is_certified_ = approach.stage == FilterStage::within;
    rough_ = between(approach.time, is_certified_);
    if (!is_certified_ && approach.stage != FilterStage::undecided) refuse();
    if (!is_certified_) exact();  // throws if the distance is always above h
  } else {
    const auto time = time_of_contact(query);
    if (!time) refuse();
    rough_ = *time;
  }
}

bool EarliestTime::is_before(double time) {
  const PlainArithmetic guard;
  int before = comparison(rough_.time, time);
  if (before < 0 && !exact_) before = comparison(narrow().time, time);
  if (before >= 0) return before == 1;
  return is_below(exact().time, time);
}

bool EarliestTime::makes_late(double time) {
  const PlainArithmetic guard;
  if (query_.separation == 0) return is_before(time);
  // If `is_certified_`, `rough_` and narrow() enclose both t* and the time at which the distance falls below
  // h.
  if (!(time > rough_.time.lo)) return false;
  if (is_certified_) {
    int late = comparison(rough_.time, time);
    if (late < 0) late = comparison(narrow().time, time);
    if (late >= 0) return late == 1;
  }
  return exact().below && is_below(*exact().below, time);
}

Enclosure EarliestTime::enclosure(double width) {
  const PlainArithmetic guard;
  if (rough_.is_known_to(width)) return rough_.time;
  const bool is_unique = width == 0;  // then narrow() and exact() give the same enclosure
  if (!(is_unique && exact_) && narrow().is_known_to(width)) return narrow().time;
  return enclose(exact().time, width);
}

std::string EarliestTime::rational() {
  const PlainArithmetic guard;
  const auto rational = Root(exact().time).as_rational();
  return rational ? mpq_class(rational->mpq()).get_str() : "";
}

const KnownTime& EarliestTime::narrow() {
  if (!narrow_) {
    narrow_ = rough_;
    if (query_.separation == 0)
      narrow_ = *time_of_contact(query_, 0);
    else if (const auto neighbours = certified::narrow_crossing(query_, rough_.time))
      narrow_ = KnownTime{*neighbours, true};
    else if (is_certified_)
      narrow_ = between(known_approach(query_, 0).time, is_certified_);
  }
  return *narrow_;
}

const exact::FirstApproach& EarliestTime::exact() {
  const auto find = [&]() -> exact::FirstApproach {
    if (query_.separation > 0) return first_approach(query_);
    const Root t = first_root(query_, narrow());
    return {t, t};
  };
  if (!exact_) exact_ = std::make_shared<exact::FirstApproach>(find());
  return *exact_;
}

}  // namespace nearmiss
