#include "reports/statistics/family_name.hpp"

#include <algorithm>

namespace nearmiss {

FamilyName::FamilyName(std::string_view name) : base(name.substr(0, name.find_first_of("@~"))) {
  for (const std::string_view each :
       {miss_search_family, far_search_family, late_search_family, early_search_family})
    for (const std::string_view begin : {std::string_view(), vertices_prefix})
      if (name.starts_with(begin) && name.substr(begin.size()).starts_with(each))
        search = name.substr(0, begin.size() + each.size() - 1);
  // The name of a subject may have a ~ of its own.
  const auto tilde = std::min(search.empty() ? name.find('~') : name.rfind('~'), name.size());
  if (tilde < name.size()) separation = name.substr(tilde + 1);
  if (base.size() < tilde) value = name.substr(base.size() + 1, tilde - base.size() - 1);
}

}  // namespace nearmiss
