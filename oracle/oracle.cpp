#include "oracle/oracle.hpp"

#include <vector>

#include "ccd/arithmetic.hpp"
#include "oracle/exact/first_contact.hpp"
#include "oracle/filter/box.hpp"
#include "oracle/filter/filter.hpp"

namespace nearmiss {

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

std::optional<ContactTime> earliest_time(const Query& query) {
  if (!decide(query).collision) return std::nullopt;
  return ContactTime(query);
}

}  // namespace nearmiss
