#include "fuzz/questions/question_trial.hpp"

#include <numeric>

#include "fuzz/search/search.hpp"
#include "reports/statistics/family.hpp"

namespace nearmiss {

std::uint64_t sum(const QueryClassCounts& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

std::uint64_t sum_that_counts(const QueryClassCounts& counts) {
  return sum(counts) - counts[static_cast<std::size_t>(QueryClass::extreme)];
}

std::vector<Family> search_families(std::string name, std::string about,
                                    std::function<Query(Random&, Kind)> make) {
  const Family search{
      .name = std::move(name), .about = std::move(about), .make = std::move(make), .block_cases = 1};
  return {search, among_vertices(search)};
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
