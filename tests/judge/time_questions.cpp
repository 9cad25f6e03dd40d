// Compares earliest times with exact decisions about the step up to some time.
#include <array>
#include <boost/multiprecision/gmp.hpp>
#include <set>

#include "fuzz/subjects/contract.hpp"
#include "fuzz/subjects/exact.hpp"
#include "oracle/agreement/checked.hpp"
#include "oracle/oracle.hpp"
#include "oracle/within_separation.hpp"
#include "tests/exact_times.hpp"
#include "tests/judge/questions.hpp"

namespace nearmiss {

namespace {

using exact::Number;
using exact::Root;
using Rational = boost::multiprecision::mpq_rational;

/// The earliest time, as far as certified bounds show it; an invalid enclosure, [1, 0], if they show that
/// there is no such time.
KnownTime known_time(const Query& query, double width) {
  if (query.separation > 0) return {known_approach(query, width).time};
  return time_of_contact(query, width).value_or(KnownTime{{1, 0}});
}

bool is_enclosure(const Enclosure& t) { return 0 <= t.lo && t.lo <= t.hi && t.hi <= 1; }

bool contains(const Enclosure& enclosure, Root& t) {
  Root lo{Number(enclosure.lo)};
  Root hi{Number(enclosure.hi)};
  return !t.is_below(lo) && !hi.is_below(t);
}

/// Compares the certified enclosures of all widths with the exact times.
std::string known_times_disagree(const Query& query, exact::FirstApproach& exactly) {
  for (const double width : {1.0, 0x1p-10, rough_time, 0.0}) {
    const KnownTime known = known_time(query, width);
    if (!is_enclosure(known.time)) return "time: no enclosure";
    if (!contains(known.time, exactly.time)) return "time: outside its enclosure";
    if (exactly.below && !contains(known.time, *exactly.below)) return "time: below outside the enclosure";
    const auto is = [&](double end) { return exactly.time.is(Number(end)); };
    if (known.is_between && (is(known.time.lo) || is(known.time.hi))) return "time: not between";
  }
  return "";
}

/// Compares t* with other times, and checks the results with the exact times.
std::string comparisons_disagree(const Query& query, EarliestTime& time, exact::FirstApproach& exactly) {
  std::set<double> others;
  for (const auto& [lo, hi] : {time.known(), known_time(query, 0).time})
    for (const double other :
         {lo / 2, below(lo), lo, above(lo), lo + (hi - lo) / 2, below(hi), hi, above(hi), (1 + hi) / 2})
      others.insert(other);
  for (const double other : others) {
    if (time.is_before(other) != testing::is_before(exactly.time, other)) return "time: before";
    const bool is_late = exactly.below && testing::is_before(*exactly.below, other);
    if (time.makes_late(other) != is_late) return "time: late";
  }
  return "";
}

/// Checks the enclosures of all widths.
std::string enclosures_disagree(const Query& query, EarliestTime& time, Root& exactly) {
  for (const double width : {1.0, 1e-3, 1e-12, 0.0}) {
    const Enclosure enclosure = time.enclosure(width);
    if (!is_enclosure(enclosure) || !contains(enclosure, exactly)) return "time: no enclosure of it";
    const auto [lo, hi] = enclosure;
    if (hi - lo > width && hi > above(lo)) return "time: wide";
    if (enclosure != EarliestTime(query).enclosure(width)) return "time: depends on other questions";
  }
  const auto [lo, hi] = time.enclosure();
  if (lo < time.known().lo || time.known().hi < hi) return "time: enclosures apart";
  if ((lo == hi) != (exactly.is(Number(lo)) || exactly.is(Number(hi)))) return "time: not exact";
  const std::string rational = time.rational();
  if (lo == hi && rational.empty()) return "time: no rational";
  if (!rational.empty() && !exactly.is(0) && !exactly.is(1)) {
    const Rational t(rational);
    if (t < Rational(lo) || t > Rational(hi)) return "time: rational";
  }
  return "";
}

}  // namespace

std::string time_disagreement(const Query& query, bool happens) {
  static const auto subject = try_make_exact("exact-scalar");
  const Verdict verdict = subject->decide(query);
  if (verdict.hit != happens) return "subject: hit";
  auto time = earliest_time(query);
  auto exactly = testing::exact_times(query);
  if (time.has_value() != happens || exactly.has_value() != happens) return "time: of nothing";
  const bool happens_at_start = happens && exactly->time.is(0);
  if (keeps_contract(query, {.apart_at_start = true}) == happens_at_start) return "contract: apart at start";
  Query contact = query;
  contact.separation = 0;
  if (keeps_contract(contact, {.apart_at_start = true, .apart_by = query.separation}) == happens_at_start)
    return "contract: apart by";
  if (!happens) return "";
  if (!is_enclosure(time->known())) return "time: no enclosure";
  std::string what = known_times_disagree(query, *exactly);
  if (what.empty()) what = comparisons_disagree(query, *time, *exactly);
  if (what.empty()) what = enclosures_disagree(query, *time, exactly->time);
  if (what.empty()) what = time_disagreement(query, decide(query));
  if (what.empty() && verdict.time != time->enclosure().lo) what = "subject: time";
  return what;
}

}  // namespace nearmiss
