#include "oracle/oracle.hpp"

#include <algorithm>
#include <vector>

#include "ccd/arithmetic.hpp"
#include "oracle/exact/first_approach.hpp"
#include "oracle/exact/first_contact.hpp"
#include "oracle/filter/box.hpp"
#include "oracle/filter/filter.hpp"
#include "oracle/within_separation.hpp"

namespace nearmiss {

Decision decide_exactly(const Query& query) {
  const PlainArithmetic guard;
  if (query.separation == 0) return {exact::any_collision(query), FilterStage::undecided};
  const auto approach = exact::first_approach(query);
  const bool comes_below = approach && approach->below;
  return {comes_below, FilterStage::undecided, approach && !comes_below};
}

bool collides_exactly(const Query& query) { return decide_exactly(query).collision; }

Decision settle(const Query& query, FilterStage stage) {
  if (stage == FilterStage::undecided) return decide_exactly(query);
  return {is_collision(stage), stage};
}

Decision decide(const Query& query) {
  if (query.separation > 0) {
    const KnownApproach known = known_approach(query);
    Decision decision = settle(query, known.stage);
    decision.known = known;
    return decision;
  }
  if (!boxes_meet(query)) return {false, FilterStage::boxes};
  return settle(query, filter(query));
}

void decide(std::span<const Query> queries, std::span<Decision> decisions) {
  if (std::any_of(queries.begin(), queries.end(), [](const Query& query) { return query.separation > 0; })) {
    std::transform(queries.begin(), queries.end(), decisions.begin(),
                   [](const Query& query) { return decide(query); });
    return;
  }
  std::vector<FilterStage> stages(queries.size());
  filter(queries, stages);
  for (std::size_t i = 0; i < queries.size(); ++i)
    decisions[i] = settle(queries[i], boxes_meet(queries[i]) ? stages[i] : FilterStage::boxes);
}

bool collides(const Query& query) { return decide(query).collision; }

std::optional<EarliestTime> earliest_time(const Query& query) {
  const Decision decision = decide(query);
  if (!decision.collision && !decision.is_tie) return std::nullopt;
  return EarliestTime(query, decision.known);
}

}  // namespace nearmiss
