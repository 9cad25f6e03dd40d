#include "reports/statistics/family.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace nearmiss {

bool is_random(std::string_view family) { return !family.ends_with('/') && !family.starts_with("scene:"); }

std::string shown_family(std::string_view family) {
  FamilyName name(family);
  if (name.search.empty()) return std::string(family);
  name.base = name.search;
  name.value.reset();
  return name.text();
}

std::string_view origin(std::string_view family) {
  return FamilyName(family).search.empty() ? family : "directed search";
}

std::string draws_of(std::string_view family) {
  FamilyName name(family);
  if (name.value) name.value = "";
  return name.text();
}

std::uint64_t most_repeats(const Statistics& statistics, std::string_view subject) {
  std::map<std::pair<Kind, std::string>, std::uint64_t> steps;
  std::uint64_t most = 1;
  for (const auto& [key, counts] : statistics.counts)
    if (key.subject == subject) most = std::max(most, ++steps[{key.kind, draws_of(key.family)}]);
  return most;
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
