#include "fuzz/trial/families_asked.hpp"

#include <algorithm>

#include "ccd/query/error.hpp"

namespace nearmiss {

namespace {

std::vector<Family> all_of(std::string_view separation) {
  std::vector<Family> all(families().begin(), families().end());
  const auto add = [&](std::span<const Family> more) { all.insert(all.end(), more.begin(), more.end()); };
  if (separation == drawn_separation) add(separation_families());
  add(vertex_families());
  return all;
}

}  // namespace

std::vector<Family> families_asked(const std::vector<std::string>& names, std::span<const Kind> asked,
                                   std::string_view separation) {
  std::vector<Family> known = all_of(separation);
  if (!names.empty()) {
    known.clear();
    for (const std::string& name : names) {
      const std::vector<Family> all = name == "all" ? all_of(separation) : std::vector<Family>();
      const std::span<const Family> group = name == "vertices" ? vertex_families() : std::span(all);
      if (group.empty())
        known.push_back(find_family(name));
      else
        known.insert(known.end(), group.begin(), group.end());
    }
  }
  std::vector<Family> chosen;
  for (const Family& each : known) {
    const bool needs_separation = !separation.empty() && !each.has_separation;
    const Family family = needs_separation     ? with_separation(each, separation)
                          : separation.empty() ? as_asked(each)
                                               : each;
    if (auto some = of_kinds(family, asked))
      chosen.push_back(std::move(*some));
    else if (std::ranges::find(names, each.name) != names.end())
      expect_kind(family, asked.front(), "families");
  }
  return chosen;
}

void expect_all_asked(const Subjects& subjects, std::span<const Family> families) {
  const auto is_asked = [](const Subject& subject, const Family& family) {
    return std::ranges::any_of(kinds_asked(family),
                               [&](Kind kind) { return subject.is_asked(kind, family.has_separation); });
  };
  for (const auto& subject : subjects)
    if (std::ranges::none_of(families, [&](const Family& family) { return is_asked(*subject, family); }))
      throw Error("found no query for '" + subject->name() +
                  "', expected families of kinds that it decides, with separations only if it takes them");
}

}  // namespace nearmiss
