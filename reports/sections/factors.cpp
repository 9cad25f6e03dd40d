#include "reports/sections/sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "reports/text/json.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

using nlohmann::ordered_json;

std::string to_text(const CommonFactors& common) {
  return fmt::format("{:.0f} % of the missed ones have {}, and {:.0f} % of all", 100 * common.share(),
                     common.key.values, 100 * common.share_of_collisions());
}

std::string common_factors_lines(const Statistics& statistics) {
  std::string lines;
  for (const CommonFactors& each : common_factors(statistics.factors))
    lines += fmt::format("{} {}, {}: {} of {} missed; {}\n", each.key.subject, short_name(each.key.kind),
                         each.key.family, with_separators(each.all.false_negatives),
                         counted(each.all.collisions, "collision", "collisions"), to_text(each));
  return lines;
}

ordered_json common_factors_json(const Statistics& statistics) {
  auto json = ordered_json::array();
  for (const CommonFactors& each : common_factors(statistics.factors))
    json.push_back({{"subject", each.key.subject},
                    {"kind", short_name(each.key.kind)},
                    {"family", each.key.family},
                    {"collisions", each.all.collisions},
                    {"false_negatives", each.all.false_negatives},
                    {"values", each.key.values},
                    {"share", each.share()},
                    {"share_of_collisions", each.share_of_collisions()},
                    {"text", to_text(each)}});
  return json;
}

namespace {

/// The ranges of values at which a subject is right, by factor (such as the edge length) and kind.
using Ranges = std::map<std::pair<std::string, Kind>, RightRange>;

/// The edge lengths and the distances at which a subject is right, for one kind or for all kinds.
struct Row {
  std::string subject;
  std::optional<Kind> kind;
  std::optional<RightRange> edge, distance;
};

bool is_everywhere(const RightRange& range) { return range.exponents && range.elsewhere == FactorCounts(); }

/// The range of a factor at which a subject is right for all kinds. Returns nothing if the ranges of the
/// kinds differ or if no kind has a range. If the subject is right at all values that two kinds have, the
/// ranges of these two kinds count as equal, even if the values differ. Kinds with too few queries are left
/// out if another kind has enough queries.
std::optional<RightRange> common(const Ranges& ranges, const std::string& factor) {
  std::optional<RightRange> all;
  const bool has_enough = std::ranges::any_of(
      ranges, [&](const auto& each) { return each.first.first == factor && !each.second.too_few; });
  for (const auto& [key, each] : ranges) {
    if (key.first != factor || (has_enough && each.too_few)) continue;
    if (!all) {
      all = each;
    } else if (is_everywhere(*all) && is_everywhere(each)) {
      all->exponents = {std::min(all->exponents->first, each.exponents->first),
                        std::max(all->exponents->second, each.exponents->second)};
    } else {
      if (all->exponents != each.exponents || all->too_few != each.too_few) return std::nullopt;
      all->elsewhere.merge(each.elsewhere);
    }
  }
  return all;
}

std::optional<RightRange> of_kind(const Ranges& ranges, const std::string& factor, Kind kind) {
  const auto found = ranges.find({factor, kind});
  return found == ranges.end() ? std::nullopt : std::optional(found->second);
}

/// A subject has one row if its ranges are the same for all kinds, otherwise a row for each kind.
std::vector<Row> rows_of(const Statistics& statistics) {
  std::map<std::string, Ranges> subjects;
  for (const RightRange& each : right_ranges(statistics.factors))
    subjects[each.subject].emplace(std::pair(each.factor, each.kind), each);
  std::vector<Row> rows;
  for (const auto& [subject, ranges] : subjects) {
    std::set<Kind> kinds;
    std::set<std::string> factors;
    for (const auto& [key, range] : ranges) {
      factors.insert(key.first);
      kinds.insert(key.second);
    }
    bool is_same = true;
    for (const std::string& factor : factors) is_same = is_same && common(ranges, factor);
    if (is_same) {
      rows.push_back({subject, std::nullopt, common(ranges, "edge"), common(ranges, "distance")});
      continue;
    }
    for (const Kind kind : kinds)
      rows.push_back({subject, kind, of_kind(ranges, "edge", kind), of_kind(ranges, "distance", kind)});
  }
  return rows;
}

std::string kind_of(const Row& row) { return row.kind ? std::string(short_name(*row.kind)) : "all"; }

/// "2^-9 to 2^30", "no range" or "too few queries"
std::string values_of(const RightRange& range) {
  if (range.too_few) return "too few queries";
  return range.exponents ? fmt::format("2^{} to 2^{}", range.exponents->first, range.exponents->second)
                         : "no range";
}

/// Says how the subject fails at the values of the factor outside the range, for example "misses 58 of 310,
/// reports 90 % of the rest". Returns "" if the subject does not fail at these values.
std::string wrong_elsewhere(const RightRange& range) {
  const FactorCounts& counts = range.elsewhere;
  std::string wrong;
  if (counts.false_negatives > 0)
    wrong = fmt::format("misses {} of {}", with_separators(counts.false_negatives),
                        with_separators(counts.collisions));
  // Reports are wrong only if they exceed a third of the queries that have no collision. A CCD that allows
  // for rounding errors may have fewer false positives than that.
  if (3 * counts.false_positives > counts.others)
    wrong += fmt::format("{}reports {} of the rest", wrong.empty() ? "" : ", ",
                         percent(counts.false_positives, counts.others));
  return wrong;
}

std::vector<std::string> cells_of(const Row& row) {
  std::vector<std::string> cells{row.subject, kind_of(row)};
  for (const auto& range : {row.edge, row.distance}) {
    cells.push_back(range ? values_of(*range) : "–");
    cells.push_back(range ? wrong_elsewhere(*range) : "");
  }
  return cells;
}

ordered_json to_json(const std::optional<RightRange>& range) {
  if (!range) return nullptr;
  ordered_json json{{"from", nullptr}, {"to", nullptr}};
  if (range->exponents) std::tie(json["from"], json["to"]) = *range->exponents;
  for_each_counter<FactorCounts>([&](const auto& counter) {
    json["elsewhere"][std::string(counter.name)] = range->elsewhere.*counter.member;
  });
  json["values"] = values_of(*range);
  json["wrong"] = wrong_elsewhere(*range);
  return json;
}

}  // namespace

std::string sizes_table(const Statistics& statistics) {
  std::vector<std::vector<std::string>> rows{
      {"subject", "kind", "right with edges of", "elsewhere", "right at a distance of", "elsewhere"}};
  for (const Row& row : rows_of(statistics)) rows.push_back(cells_of(row));
  if (rows.size() == 1) return "";
  return columns(rows, rows.front().size()) +
         "right: no miss, and no more than 25 % above the lowest rate of false positives where nothing is "
         "missed; distance: from the "
         "origin, in edges;\nno range: what is wrong does not depend on the size, or is too rare to tell\n";
}

ordered_json sizes_json(const Statistics& statistics) {
  auto json = ordered_json::array();
  for (const Row& row : rows_of(statistics))
    json.push_back({{"subject", row.subject},
                    {"kind", kind_of(row)},
                    {"edge", to_json(row.edge)},
                    {"distance", to_json(row.distance)}});
  return json;
}

}  // namespace nearmiss
