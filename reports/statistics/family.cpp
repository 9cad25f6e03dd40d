#include "reports/statistics/family.hpp"

#include <algorithm>

namespace nearmiss {

bool is_random(std::string_view family) { return !family.ends_with('/') && !family.starts_with("scene:"); }

std::string shown_family(std::string_view family) {
  const FamilyName name(family);
  if (name.search.empty()) return std::string(family);
  std::string shown(name.search);
  return name.separation.empty() ? shown : shown.append("~").append(name.separation);
}

std::string_view origin(std::string_view family) {
  return FamilyName(family).search.empty() ? family : "directed search";
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
