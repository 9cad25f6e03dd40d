#include "reports/statistics/family.hpp"

#include <algorithm>

namespace nearmiss {

bool is_random(std::string_view family) { return !family.ends_with('/') && !family.starts_with("scene:"); }

std::string shown_family(std::string_view family) {
  const std::string_view separation = family.substr(std::min(family.rfind('~'), family.size()));
  for (const std::string_view search :
       {miss_search_family, far_search_family, late_search_family, early_search_family})
    if (family.starts_with(search))
      return std::string(search.substr(0, search.size() - 1)).append(separation);
  return std::string(family);
}

std::string_view origin(std::string_view family) {
  return shown_family(family) == family ? family : "directed search";
}

Statistics by_shown_family(const Statistics& statistics) {
  Statistics shown = statistics;
  shown.counts.clear();
  for (const auto& [key, counts] : statistics.counts)
    shown.counts[{key.subject, key.kind, shown_family(key.family)}].merge(counts);
  shown.oracle.clear();
  for (const auto& [key, counts] : statistics.oracle)
    shown.oracle[{key.first, shown_family(key.second)}].merge(counts);
  return shown;
}

}  // namespace nearmiss
