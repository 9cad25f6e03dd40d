#include "reports/statistics/family.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "reports/statistics/family_name.hpp"
#include "reports/statistics/sums.hpp"

namespace nearmiss {

FamilyName::FamilyName(std::string_view name) : base(name.substr(0, name.find_first_of("@~"))), root(base) {
  if (base.starts_with(vertices_prefix)) root.remove_prefix(vertices_prefix.size());
  for (const std::string_view each :
       {miss_search_family, far_search_family, late_search_family, early_search_family})
    if (root.starts_with(each)) search = name.substr(0, base.size() - root.size() + each.size() - 1);
  // The family of a search contains the name of a subject, which may have a ~. So the last ~ begins the
  // separation.
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

std::string scene_of(const std::string& step) { return step.substr(0, step.rfind('#')); }

namespace {

// For each class, the names of its families, each between two blanks. Only this table says which class a
// family has.
constexpr std::array<std::string_view, 3> classes{
    " near near-within v-drifting v-rest-angle v-rest-ratio rest rest-units rest-distant uniform "
    "uniform-end uniform-slow mesh floats kilometres metres units distant v-small-integer "
    "v-decimals v-reached-separation ",
    " v-along rest-touching rest-angle rest-ratio v-shrinking v-minimum planted planted-ulp "
    "grazing parallel sliver planar small-integer unit-integer degenerate decimals "
    "near-parallel-edges needle rigid end-contact even-roots triple-root far-end far-start "
    "first-moment one-point touch-twice crossed close-roots touch-once border-first return-later "
    "slow-contact near-separation tied-separation reached-separation slow-approach "
    "changed-features starts-near-separation ",
    " small stiff aspect offset scale overflow mixed-scale static-pair near-overflow "
    "near-overflow-planted near-underflow near-underflow-planted sized-separation v-one-point "};
static_assert(classes.size() == static_cast<std::size_t>(QueryClass::unclassified));

QueryClass class_in_table(std::string_view name) {
  const std::string word = ' ' + std::string(name) + ' ';
  const auto has_word = [&](std::string_view words) { return words.find(word) != words.npos; };
  // a name with a blank is no word of the table; such a name may come from a forged store
  const bool is_word = name.find(' ') == name.npos;
  const auto found = is_word ? std::ranges::find_if(classes, has_word) : classes.end();
  return static_cast<QueryClass>(found - classes.begin());
}

}  // namespace

QueryClass class_of(std::string_view family) {
  if (family.starts_with("scene:")) return QueryClass::ordinary;
  // if the name of a simulation contains options or sizes, the class of the simulation is not known
  if (family.starts_with("sim:"))
    return family.find_first_of("@~:", 4) == std::string_view::npos ? QueryClass::ordinary
                                                                    : QueryClass::unclassified;
  const FamilyName name(family);
  // The family v-NAME, whose queries have the kinds vv and ve, has the class of NAME unless the table lists
  // v-NAME itself.
  const QueryClass own = class_in_table(name.base);
  return own == QueryClass::unclassified ? class_in_table(name.root) : own;
}

std::map<ClassKey, CountsSum> by_class(const Statistics& statistics) {
  return sums_by(statistics, [](const CountsKey& key) {
    return ClassKey{key.subject, key.kind, class_of(key.family)};
  });
}

}  // namespace nearmiss
