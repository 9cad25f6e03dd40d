#include "fuzz/search/searched.hpp"

#include <memory>

#include "reports/statistics/family_name.hpp"

namespace nearmiss {

double Searched::separation(Random& random, Kind kind) const {
  if (!separation_) return 0;
  const SearchPoint typical = draw_search_point(random, usually_smallest);
  return separation_(random, query_of(kind, typical, 0));
}

double Searched::objective(const Query& query, const Value& value,
                           const std::function<double()>& if_slow) const {
  constexpr int most_slow_searches = 3;
  stop_.check();
  if (!is_finite(query) || slow_searches_ >= most_slow_searches) return unwanted;
  const Verdict answer = subject_.decide(query);
  if (answer.fault == Fault::contract) return unwanted;
  return answer.fault == Fault::time ? if_slow() : value(answer);
}

/// A query of directed search takes about as long as a few thousand others. The subjects' times do not count,
/// because batches are small, and the search leaves the caches warm only for the subject that it searches.
Family search_family(std::string_view prefix, std::string_view about, SearchOne search_one,
                     const Subject& subject, const Stop& stop, std::string_view separation) {
  const std::string name = std::string(prefix) + subject.name();
  ChooseSeparation choose;
  if (!separation.empty()) choose = parse_family_separation(separation, name);
  const auto searched = std::make_shared<Searched>(subject, stop, choose);
  return {.name = separation.empty() ? name : name_with_separation(name, separation),
          .about = std::string(about),
          .make = [searched, search_one](Random& random,
                                         Kind kind) { return search_one(*searched, random, kind); },
          .block_cases = 1,
          .timed = false,
          .has_separation = !separation.empty()};
}

}  // namespace nearmiss
