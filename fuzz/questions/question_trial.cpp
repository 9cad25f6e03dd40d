#include "fuzz/questions/question_trial.hpp"

#include <numeric>

#include "reports/statistics/family_class.hpp"

namespace nearmiss {

std::uint64_t sum(const QueryClassCounts& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

std::uint64_t sum_that_counts(const QueryClassCounts& counts) {
  return sum(counts) - counts[static_cast<std::size_t>(QueryClass::extreme)];
}

std::vector<Family> families_of_questions(bool at_rest) {
  std::vector<Family> known;
  if (at_rest) known.assign(families_at_rest().begin(), families_at_rest().end());
  for (const auto& all : {families(), vertex_families()}) known.insert(known.end(), all.begin(), all.end());
  return known;
}

std::vector<Family> usual_families_of_questions(bool at_rest) {
  std::vector<Family> usual = families_of_questions(at_rest);
  std::erase_if(usual, [](const Family& each) { return class_of(each.name) == QueryClass::extreme; });
  return usual;
}

}  // namespace nearmiss
