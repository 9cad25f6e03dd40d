#include "reports/sections/sizes_table.hpp"

#include <fmt/format.h>

#include <map>
#include <set>
#include <vector>

#include "reports/text/json.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

/// What is wrong elsewhere: "58 of 310 collisions missed", "90 % of the others reported"; "" if nothing is.
std::string wrong_elsewhere(const FactorCounts& counts) {
  if (counts.false_negatives > 0)
    return fmt::format("{} of {} missed", with_separators(counts.false_negatives),
                       counted(counts.collisions, "collision", "collisions"));
  if (counts.false_positives == 0) return "";
  return fmt::format(
      "{:.0f} % of those that do not collide reported",
      100.0 * static_cast<double>(counts.false_positives) / static_cast<double>(counts.others));
}

/// "2^-9 to 2^30, elsewhere 58 of 310 collisions missed"
std::string to_text(const RightRange& range) {
  const std::string wrong = wrong_elsewhere(range.elsewhere);
  if (!range.exponents) return fmt::format("nowhere: {}", wrong);
  return fmt::format("2^{} to 2^{}{}{}", range.exponents->first, range.exponents->second,
                     wrong.empty() ? "" : "; elsewhere ", wrong);
}

/// The ranges of a subject's kinds: "2^-30 to 2^30" if all are the same, else "vt ..., ee ...".
std::string to_text(const std::vector<RightRange>& of_kinds) {
  std::set<std::string> texts;
  std::string by_kind;
  for (const RightRange& each : of_kinds) {
    texts.insert(to_text(each));
    by_kind += fmt::format("{}{} {}", by_kind.empty() ? "" : " | ", short_name(each.kind), to_text(each));
  }
  return texts.size() == 1 ? *texts.begin() : by_kind;
}

}  // namespace

std::string sizes_table(const Statistics& statistics) {
  std::map<std::string, std::map<std::string, std::vector<RightRange>>> by_subject;
  for (const RightRange& each : right_ranges(statistics.factors))
    by_subject[each.subject][each.factor].push_back(each);
  if (by_subject.empty()) return "";
  std::vector<std::vector<std::string>> rows{
      {"subject", "right with edges of", "right at a distance from the origin, in edges, of"}};
  for (auto& [subject, of_factor] : by_subject)
    rows.push_back({subject, to_text(of_factor["edge"]), to_text(of_factor["distance"])});
  return columns(rows, 3);
}

nlohmann::ordered_json sizes_json(const Statistics& statistics) {
  auto json = nlohmann::ordered_json::array();
  for (const RightRange& each : right_ranges(statistics.factors))
    json.push_back({{"subject", each.subject},
                    {"kind", short_name(each.kind)},
                    {"factor", each.factor},
                    {"from", each.exponents ? nlohmann::ordered_json(each.exponents->first) : nullptr},
                    {"to", each.exponents ? nlohmann::ordered_json(each.exponents->second) : nullptr},
                    {"elsewhere",
                     {{"collisions", each.elsewhere.collisions},
                      {"false_negatives", each.elsewhere.false_negatives},
                      {"others", each.elsewhere.others},
                      {"false_positives", each.elsewhere.false_positives}}},
                    {"text", to_text(each)}});
  return json;
}

}  // namespace nearmiss
