#include "reports/statistics/family_name.hpp"

#include <algorithm>

namespace nearmiss {

FamilyName::FamilyName(std::string_view name) : base(name.substr(0, name.find_first_of("@~"))), root(base) {
  if (base.starts_with(vertices_prefix)) root.remove_prefix(vertices_prefix.size());
  for (const std::string_view each :
       {miss_search_family, far_search_family, late_search_family, early_search_family})
    if (root.starts_with(each)) search = name.substr(0, base.size() - root.size() + each.size() - 1);
  // The name of a search's subject may contain a ~, so the last one counts.
  const auto tilde = std::min(search.empty() ? name.find('~') : name.rfind('~'), name.size());
  if (tilde < name.size()) separation = name.substr(tilde + 1);
  if (base.size() < tilde) value = name.substr(base.size() + 1, tilde - base.size() - 1);
}

std::string FamilyName::text() const {
  std::string name(base);
  if (value) name.append("@").append(*value);
  return separation ? name_with_separation(name, *separation) : name;
}

std::string name_with_separation(std::string_view name, std::string_view separation) {
  return std::string(name).append("~").append(separation);
}

}  // namespace nearmiss
