#include "oracle/filter/filter.hpp"

#include <algorithm>
#include <cmath>

#include "ccd/query/arithmetic.hpp"
#include "oracle/filter/box.hpp"
#include "oracle/filter/end_contact.hpp"
#include "oracle/filter/instruction_sets.hpp"
#include "oracle/filter/planes.hpp"
#include "oracle/filter/search.hpp"

namespace nearmiss {

namespace certified {
namespace {

template <Kind kind, class Points>
bool separated_by_a_plane(const Points& x) {
  return separated_across_axes<kind>(x) || separated_across_diagonals<kind>(x);
}

template <class Real>
FilterStage search(const Query& query, const Bernstein<Real, 4>& F, const StepPart<Real>& whole) {
  return ContactSearch<Real>(query.kind, whole, whole, F, 0).run();
}

FilterStage search_in_double_words(const Query& query) {
  const auto whole = whole_step<DoubleWord>(coordinates(query));
  const auto F = coplanarity(whole.a, whole.b, whole.c);
  if (common_sign(F.b, F.error) != 0) return FilterStage::one_sign;
  return search(query, F, whole);
}

[[gnu::noinline]] FilterStage look_closer(const Query& query, const StepPart<double>& whole,
                                          const Bernstein<double, 4>& F) {
  for (const int time : {0, 1})
    if (!(std::abs(F.b[time == 0 ? 0 : 3]) > F.error) && touch_at_end(query, time))
      return FilterStage::at_an_end;
  const FilterStage stage = search(query, F, whole);
  return stage == FilterStage::undecided ? search_in_double_words(query) : stage;
}

/// An interval that contains the first contact, if there is one; nothing if there certainly is none.
template <class Real>
std::optional<KnownTime> search_for_time(const Query& query, const Bernstein<Real, 4>& F,
                                         const StepPart<Real>& whole, Asked asked) {
  ContactSearch<Real> search(query.kind, whole, whole, F, 0, asked);
  search.run();
  const auto first = search.first();
  if (!first) return std::nullopt;
  return KnownTime{*first, search.is_between()};
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
                Instructions instructions) {
  const PlainArithmetic guard;
  FilterBatch* const filter_batch = filter_with(instructions);
  for (std::size_t first = 0; first < queries.size(); first += batch_size) {
    const std::size_t count = std::min(batch_size, queries.size() - first);
    const std::size_t ahead = std::min(first + batch_size, queries.size() - count);
    filter_batch(queries.part(first, count), caution, &stages[first], queries.part(ahead, count));
  }
}

}  // namespace
}  // namespace certified

FilterStage filter(const Query& query) {
  using namespace certified;
  const PlainArithmetic guard;
  if (!is_finite(query)) return FilterStage::undecided;
  const auto x = coordinates(query);
  if (with_kind(query.kind, [&]<Kind kind>() { return separated_by_a_plane<kind>(x); }))
    return FilterStage::planes;
  StepPart<double> whole{
      0, 1, difference<double>(x, 1, 0), difference<double>(x, 2, 0), difference<double>(x, 3, 0), {}, {}};
  const auto F = coplanarity(whole.a, whole.b, whole.c);
  if (common_sign(F.b, F.error) != 0) return FilterStage::one_sign;
  whole.x21 = difference<double>(x, 2, 1);
  whole.x31 = difference<double>(x, 3, 1);
  return look_closer(query, whole, F);
}

std::optional<KnownTime> time_of_contact(const Query& query, double width) {
  using namespace certified;
  const PlainArithmetic guard;
  if (!is_finite(query)) return KnownTime{{0, 1}};
  const auto whole = whole_step<double>(coordinates(query));
  const auto F = coplanarity(whole.a, whole.b, whole.c);
  if (common_sign(F.b, F.error) != 0) return std::nullopt;
  if (!(std::abs(F.b[0]) > F.error) && touch_at_end(query, 0)) return KnownTime{{0, 0}};
  if (width > 0) {  // an enclosure in double is always wider than 0
    const auto time = search_for_time(query, F, whole, Asked::when);
    if (!time || time->time.hi - time->time.lo <= width) return time;
  }
  const auto in_words = whole_step<DoubleWord>(coordinates(query));
  return search_for_time(query, coplanarity(in_words.a, in_words.b, in_words.c), in_words,
                         width < rough_time ? Asked::when_precisely : Asked::when);
}

void filter(const QueryRows& queries, std::span<FilterStage> stages, Instructions instructions) {
  certified::filter_all(queries, 1, stages, instructions);
  for (std::size_t i = 0; i < queries.size(); ++i)
    if (stages[i] == FilterStage::undecided) {
      const Query query = queries[i];
      if (is_finite(query)) stages[i] = boxes_meet(query) ? filter(query) : FilterStage::boxes;
    }
}

void filter_with_caution(std::span<const Query> queries, double caution, std::span<FilterStage> stages) {
  certified::filter_all(QueryRows(queries), caution, stages, chosen_instructions());
}

}  // namespace nearmiss
