#include "tests/judge/questions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "oracle/agreement/answers.hpp"
#include "oracle/features.hpp"
#include "oracle/filter/box.hpp"
#include "oracle/filter/filter.hpp"
#include "oracle/oracle.hpp"
#include "tests/root_count.hpp"

namespace nearmiss {

namespace {

using Stages = std::vector<FilterStage>;

/// The filters' answers to some queries.
struct Filtered {
  Stages batch;     ///< many queries at once, by vector instructions only
  Stages cautious;  ///< as `batch`, with all bounds multiplied by eight
  Stages scalar;    ///< one query at a time
};

bool is_decided(FilterStage stage) { return stage != FilterStage::undecided; }

/// Whether both stages decide, with different answers.
bool contradict(FilterStage a, FilterStage b) {
  return is_decided(a) && is_decided(b) && is_collision(a) != is_collision(b);
}

Filtered ask_filters(std::span<const Query> queries) {
  constexpr double caution = 8;
  Filtered filtered{Stages(queries.size()), Stages(queries.size()), Stages(queries.size())};
  filter_with_caution(queries, 1, filtered.batch);
  filter_with_caution(queries, caution, filtered.cautious);
  for (std::size_t i = 0; i < queries.size(); ++i)
    filtered.scalar[i] = boxes_meet(queries[i]) ? filter(queries[i]) : FilterStage::boxes;
  return filtered;
}

/// Compares the filters with each other.
std::optional<Contradiction> filters_disagree(std::span<const Query> queries, const Filtered& filtered) {
  Stages widest(queries.size());
  filter(queries, widest, widest_instructions());
  for (const Instructions narrower : {Instructions::sse2, Instructions::avx2}) {
    if (!has(narrower)) continue;
    Stages stages(queries.size());
    filter(queries, stages, narrower);
    for (std::size_t i = 0; i < queries.size(); ++i)
      if (stages[i] != widest[i]) return Contradiction{i, "instruction sets"};
  }
  for (std::size_t i = 0; i < queries.size(); ++i) {
    if (contradict(filtered.batch[i], filtered.scalar[i])) return Contradiction{i, "batch against scalar"};
    if (contradict(filtered.batch[i], filtered.cautious[i])) return Contradiction{i, "batch against caution"};
    const bool is_batch = widest[i] == filtered.batch[i];
    if (!is_batch && widest[i] != filtered.scalar[i]) return Contradiction{i, "stages of many"};
  }
  return std::nullopt;
}

/// One query in this many is asked each exact question. Each number divides the next one, so that a query
/// that is asked a slower question is also asked the faster ones.
struct SamplingRates {
  std::uint64_t exact, others, distance;
};

SamplingRates sampling_rates(FilterStage batch, FilterStage cautious, FilterStage scalar) {
  if (!is_decided(scalar)) return {1, 4, 32};
  if (!is_decided(batch)) return {1, 16, 128};     // hard to decide
  if (!is_decided(cautious)) return {1, 64, 256};  // near the filter's bounds
  switch (batch) {
    case FilterStage::planes:
      return {64, 256, 512};
    case FilterStage::one_sign:
      return {16, 128, 256};
    default:
      return {8, 64, 128};
  }
}

/// Compares all decisions of the filters with the exact answer.
std::string filters_against(bool exact, const Query& query, std::size_t i, const Filtered& filtered) {
  const auto is_wrong = [&](FilterStage stage) { return is_decided(stage) && is_collision(stage) != exact; };
  if (is_wrong(filtered.batch[i])) return "batch against exact";
  if (is_wrong(filtered.cautious[i])) return "caution against exact";
  if (is_wrong(filtered.scalar[i])) return "scalar against exact";
  if (exact && !boxes_meet(query)) return "boxes against exact";
  if (decide(query).collision != exact) return "decide against exact";
  return "";
}

/// Compares the features of the first contact with the roots of F.
std::string features_against(const testing::RootCount& count, const Query& query) {
  const auto features = contact_features(query);
  if (features.has_value() != count.collision) return "features against roots";
  if (!features) return "";
  if ((features->multiplicity == ContactFeatures::Multiplicity::planar) != count.planar)
    return "features: planar";
  if (count.distinct != 1) return "";  // with one root, the first contact is the only one
  if ((features->multiplicity == ContactFeatures::Multiplicity::multiple) != (count.with_multiplicity > 1))
    return "features: multiplicity";
  const bool within = features->location == ContactFeatures::Location::interior && !features->degenerate &&
                      features->time == ContactFeatures::Time::inside;
  return within == count.on_boundary ? "features: boundary" : "";
}

std::string exact_answers_disagree(const Query& query, bool exact) {
  if (const std::string parts = ask_others(query, {.collision = exact}).disagreement(); !parts.empty())
    return "answers: " + parts;
  return features_against(testing::count_roots(query), query);
}

std::string slow_answers_disagree(const Query& query, bool exact) {
  std::string what = time_disagreement(query, exact);
  return what.empty() ? translation_disagreement(query) : what;
}

/// Asks all questions about one query that need exact arithmetic.
std::string query_disagreement(const Query& query, std::uint64_t index, std::size_t i,
                               const Filtered& filtered) {
  const SamplingRates share = sampling_rates(filtered.batch[i], filtered.cautious[i], filtered.scalar[i]);
  const std::uint64_t number = index / 2;  // position of the query among those of its kind
  if (number % share.exact != 0) return "";
  const bool exact = collides_exactly(query);
  std::string what = filters_against(exact, query, i, filtered);
  if (what.empty() && number % share.others == 0) what = exact_answers_disagree(query, exact);
  if (what.empty() && number % share.others == 0) what = slow_answers_disagree(query, exact);
  if (what.empty() && number % (share.distance * (is_wide(query) ? 16 : 1)) == 0)
    what = distance_disagreement(query, exact);
  return what;
}

}  // namespace

bool is_wide(const Query& query) {
  double largest = 0;
  double smallest = std::numeric_limits<double>::infinity();
  for (const double c : query.x) {
    largest = std::max(largest, std::abs(c));
    if (c != 0) smallest = std::min(smallest, std::abs(c));
  }
  return smallest < 0x1p-300 * largest || largest > 0x1p1000;
}

std::optional<Contradiction> first_disagreement(std::span<const Query> queries, std::uint64_t first,
                                                const Watch& watch) {
  watch(0);
  const Filtered filtered = ask_filters(queries);
  if (auto found = filters_disagree(queries, filtered)) return found;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    watch(i);
    std::string what = query_disagreement(queries[i], first + i, i, filtered);
    if (!what.empty()) return Contradiction{i, std::move(what)};
  }
  return std::nullopt;
}

}  // namespace nearmiss
