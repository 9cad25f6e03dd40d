#include "oracle/filter/filter.hpp"

#include <algorithm>
#include <cmath>

#include "ccd/query/arithmetic.hpp"
#include "ccd/query/lanes.hpp"
#include "oracle/arithmetic/doubles_around.hpp"
#include "oracle/filter/box.hpp"
#include "oracle/filter/instruction_sets.hpp"
#include "oracle/filter/neighbours.hpp"
#include "oracle/filter/planes.hpp"
#include "oracle/filter/search.hpp"
#include "oracle/filter/sure_contact.hpp"

namespace nearmiss {

namespace certified {
namespace {

/// Whether a plane perpendicular to an axis or a diagonal separates the primitives. Each call of `across`
/// tests two of these directions, one per lane.
template <Kind kind>
bool separated_by_a_plane(const Query& query) {
  using Two = Lanes<2>;
  const auto across = [&](const auto& height) {
    return any_of(is_separated<kind>(
        [&](std::size_t time, std::size_t vertex) { return height(&query.x[12 * time + 3 * vertex]); },
        IsAbove{}));
  };
  const auto xy = [](const double* p) { return Two::load(p); };
  const auto yz = [](const double* p) { return Two::load(p + 1); };
  return across(xy) || across(yz) || across([&](const double* p) { return xy(p) + yz(p); }) ||
         across([&](const double* p) { return xy(p) - yz(p); }) || across([](const double* p) {
           return Two::gather([&](std::size_t lane) { return lane == 0 ? p[2] + p[0] : p[2] - p[0]; });
         });
}

/// The result of a ContactSearch: `stage` is the result of run(); `time` has the results of first() and
/// is_between(), and is empty if first() returns nothing.
struct Found {
  FilterStage stage;
  std::optional<KnownTime> time;
};

template <class Real>
Found search(const Query& query, const Bernstein<Real, 4>& F, const StepPart<Real>& whole,
             Asked asked = Asked::whether) {
  ContactSearch<Real> search(query.kind, whole, whole, F, 0, asked);
  const FilterStage stage = search.run();
  if (const auto first = search.first()) return {stage, KnownTime{*first, search.is_between()}};
  return {stage, std::nullopt};
}

[[gnu::noinline]] FilterStage search_in_double_words(const Query& query) {
  const auto whole = whole_step<DoubleWord>(coordinates(query));
  const auto F = coplanarity(whole.a, whole.b, whole.c);
  if (common_sign(F.b, F.error) != 0) return FilterStage::one_sign;
  return search(query, F, whole).stage;
}

/// The neighbouring doubles around the first contact, or the double at which the contact happens; nothing if
/// neither can be shown. The argument `time` encloses the first contact, if there is one. All calls are
/// inlined, so that the compiler drops computations whose results are not used.
[[gnu::flatten]] std::optional<KnownTime> between_neighbours(const Query& query,
                                                             const Bernstein<double, 4>& F,
                                                             const Enclosure& time) {
  const auto [lo, hi, hold] =
      neighbours_of_root(whole_step<DoubleWord>(coordinates(query)), F, time.lo, time.hi);
  if (hold) return KnownTime{{lo, hi}, true};
  // If F is monotone in the interval, F has at most one root in it, so a contact at t is the only contact in
  // it.
  const double t = simplest_between(time.lo, time.hi);
  if (derivative(F).sign_on(time.lo, time.hi) == 0 || !touch_at(query, t)) return std::nullopt;
  return KnownTime{{t, t}};
}

/// Decides a query whose coplanarity cubic F may have a root. If `time` is not null, sets `time` to two
/// neighbouring doubles around the first contact or to the time of this contact, if the search finds one of
/// these.
[[gnu::noinline, gnu::flatten]] FilterStage look_closer(const Query& query, const StepPart<double>& whole,
                                                        const Bernstein<double, 4>& F, KnownTime* time) {
  const auto may_touch_at = [&](int end) { return !(std::abs(F.b[end == 0 ? 0 : 3]) > F.error); };
  if (may_touch_at(0) && touch_at(query, 0)) {
    if (time != nullptr) *time = {{0, 0}};
    return FilterStage::at_an_end;
  }
  if (time == nullptr && may_touch_at(1) && touch_at(query, 1)) return FilterStage::at_an_end;
  Found found = search(query, F, whole, time == nullptr ? Asked::whether : Asked::when);
  if (time != nullptr && found.time) {
    if (const auto neighbours = between_neighbours(query, F, found.time->time)) *time = *neighbours;
    // There may be an unclear part before the contact. A search that is not asked for a time ends at such a
    // part, but this search has gone on. The stage must not depend on whether a time is asked for, so it is
    // taken from a second search, which is not asked for a time.
    if (!found.time->is_between) found = search(query, F, whole);
  }
  if (found.stage != FilterStage::undecided) return found.stage;
  if ((time != nullptr && may_touch_at(1) && touch_at(query, 1)) ||
      (found.time && touch_at(query, simplest_between(found.time->time.lo, found.time->time.hi))) ||
      crosses_in_a_plane(query))
    return FilterStage::at_an_end;
  return search_in_double_words(query);
}

FilterBatch* filter_with(Instructions instructions) {
  switch (instructions) {
    case Instructions::avx512:
      return filter_with_avx512;
    case Instructions::avx2:
      return filter_with_avx2;
    default:
      return filter_with_sse2;
  }
}

void filter_all(const QueryRows& queries, double caution, std::span<FilterStage> stages,
                std::span<KnownTime> times, Instructions instructions) {
  const PlainArithmetic guard;
  FilterBatch* const filter_batch = filter_with(instructions);
  for (std::size_t first = 0; first < queries.size(); first += batch_size) {
    const std::size_t count = std::min(batch_size, queries.size() - first);
    const std::size_t ahead = std::min(first + batch_size, queries.size() - count);
    filter_batch(queries.part(first, count), caution, &stages[first], times.empty() ? nullptr : &times[first],
                 queries.part(ahead, count));
  }
}

[[gnu::flatten]] FilterStage filter(const Query& query, KnownTime* time) {
  const PlainArithmetic guard;
  if (!is_finite(query)) return FilterStage::undecided;
  const auto x = coordinates(query);
  if (with_kind(query.kind, [&]<Kind kind>() { return separated_by_a_plane<kind>(query); }))
    return FilterStage::planes;
  const auto whole = whole_step<double>(x);
  const auto F = coplanarity(whole.a, whole.b, whole.c);
  if (common_sign(F.b, F.error) != 0) return FilterStage::one_sign;
  return look_closer(query, whole, F, time);
}

/// Decides many queries, and finds the times of their first contacts if `times` is not empty.
void filter(const QueryRows& queries, std::span<FilterStage> stages, std::span<KnownTime> times,
            Instructions instructions) {
  const PlainArithmetic guard;
  filter_all(queries, 1, stages, times, instructions);
  for (std::size_t i = 0; i < queries.size(); ++i)
    if (stages[i] == FilterStage::undecided) {
      const Query query = queries[i];
      if (!is_finite(query)) continue;
      if (!boxes_meet(query))
        stages[i] = FilterStage::boxes;
      else if (times.empty() && crosses_in_a_plane(query))  // a search before this test would probably fail
        stages[i] = FilterStage::at_an_end;
      else
        stages[i] = filter(query, times.empty() ? nullptr : &times[i]);
    }
}

}  // namespace
}  // namespace certified

FilterStage filter(const Query& query) { return certified::filter(query, nullptr); }

FilterStage filter_for_time(const Query& query, KnownTime& time) {
  time = {{0, 1}};
  return certified::filter(query, &time);
}

std::optional<KnownTime> time_of_contact(const Query& query, double width) {
  using namespace certified;
  const PlainArithmetic guard;
  if (!is_finite(query)) return KnownTime{{0, 1}};
  const auto whole = whole_step<double>(coordinates(query));
  const auto F = coplanarity(whole.a, whole.b, whole.c);
  if (common_sign(F.b, F.error) != 0) return std::nullopt;
  if (!(std::abs(F.b[0]) > F.error) && touch_at(query, 0)) return KnownTime{{0, 0}};
  const auto time = search(query, F, whole, Asked::when).time;
  if (!time || time->time.hi - time->time.lo <= width) return time;
  const bool is_precise = width < rough_time;
  if (is_precise)
    if (const auto neighbours = between_neighbours(query, F, time->time)) return neighbours;
  const auto in_words = whole_step<DoubleWord>(coordinates(query));
  return search(query, coplanarity(in_words.a, in_words.b, in_words.c), in_words,
                is_precise ? Asked::when_precisely : Asked::when)
      .time;
}

void filter(const QueryRows& queries, std::span<FilterStage> stages, Instructions instructions) {
  certified::filter(queries, stages, {}, instructions);
}

void filter_for_times(const QueryRows& queries, std::span<FilterStage> stages, std::span<KnownTime> times,
                      Instructions instructions) {
  std::ranges::fill(times, KnownTime{{0, 1}});
  certified::filter(queries, stages, times, instructions);
}

void filter_with_caution(std::span<const Query> queries, double caution, std::span<FilterStage> stages) {
  certified::filter_all(QueryRows(queries), caution, stages, {}, chosen_instructions());
}

}  // namespace nearmiss
