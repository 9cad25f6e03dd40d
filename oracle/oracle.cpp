#include "oracle/oracle.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "ccd/query/arithmetic.hpp"
#include "oracle/exact/first_approach.hpp"
#include "oracle/exact/first_contact.hpp"
#include "oracle/filter/box.hpp"
#include "oracle/filter/filter.hpp"
#include "oracle/within_separation.hpp"

namespace nearmiss {

Decision decide_exactly(const Query& query) {
  const PlainArithmetic guard;
  Decision decision{false, FilterStage::undecided};
  std::optional<exact::FirstApproach> approach;
  if (query.separation == 0) {
    auto [any, first] = exact::any_collision(query);
    decision.collision = any;
    if (first) approach = exact::FirstApproach{*first, *first};
  } else {
    approach = exact::first_approach(query);
    decision.collision = approach && approach->below;
    decision.is_tie = approach && !approach->below;
  }
  if (approach) decision.known.exactly = std::make_shared<exact::FirstApproach>(*std::move(approach));
  return decision;
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
    decision.known.approach = known;
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
  for (std::size_t i = 0; i < queries.size(); ++i) decisions[i] = settle(queries[i], stages[i]);
}

bool collides(const Query& query) { return decide(query).collision; }

std::optional<EarliestTime> earliest_time(const Query& query) {
  const Decision decision = decide(query);
  if (!decision.collision && !decision.is_tie) return std::nullopt;
  return EarliestTime(query, decision.known);
}

}  // namespace nearmiss
