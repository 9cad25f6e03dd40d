#include "reports/statistics/family.hpp"

namespace nearmiss {

bool is_random(std::string_view family) { return !family.ends_with('/') && !family.starts_with("scene:"); }

std::string_view shown_family(std::string_view family) {
  for (const std::string_view search : {miss_search_family, far_search_family})
    if (family.starts_with(search)) return search.substr(0, search.size() - 1);
  return family;
}

std::string_view origin(std::string_view family) {
  return shown_family(family) == family ? family : "directed search";
}

Statistics by_shown_family(const Statistics& statistics) {
  Statistics shown = statistics;
  shown.counts.clear();
  for (const auto& [key, counts] : statistics.counts)
    shown.counts[{key.subject, key.kind, std::string(shown_family(key.family))}].merge(counts);
  shown.oracle.clear();
  for (const auto& [key, counts] : statistics.oracle)
    shown.oracle[{key.first, std::string(shown_family(key.second))}].merge(counts);
  return shown;
}

}  // namespace nearmiss
