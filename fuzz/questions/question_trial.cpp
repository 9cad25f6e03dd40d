#include "fuzz/questions/question_trial.hpp"

#include <numeric>

namespace nearmiss {

std::uint64_t sum(const QueryClassCounts& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

std::uint64_t sum_that_counts(const QueryClassCounts& counts) {
  return sum(counts) - counts[static_cast<std::size_t>(QueryClass::extreme)];
}

void add_up(QueryClassCounts& own, const QueryClassCounts& other) {
  std::ranges::transform(own, other, own.begin(), std::plus<>());
}

}  // namespace nearmiss
