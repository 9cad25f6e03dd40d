#include "oracle/oracle.hpp"

#include <gmpxx.h>

#include <cmath>
#include <vector>

#include "ccd/arithmetic.hpp"
#include "oracle/exact/first_contact.hpp"
#include "oracle/filter/box.hpp"
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
Enclosure enclose(Root t, double width) {
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

std::string to_text(const std::optional<CGAL::Gmpq>& rational) {
  if (!rational) return {};
  return mpq_class(rational->mpq()).get_str();
}

}  // namespace

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
  return ContactTime{enclose(contact->time, width), to_text(contact->time.as_rational())};
}

}  // namespace nearmiss
