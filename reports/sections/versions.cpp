#include "reports/sections/sections.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "reports/statistics/family.hpp"
#include "reports/text/json.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

/// A number that is shown for each pair of versions.
struct VersionMeasure {
  std::string_view key;   ///< in report.json
  std::string_view text;  ///< the words that follow the number; "" if the terminal does not show the number
  std::uint64_t (*value)(const VersionCounts&);
};

constexpr std::array measures{
    VersionMeasure{"fixed", "fixed", [](const VersionCounts& counts) { return counts.fixed; }},
    VersionMeasure{"broken", "broken", [](const VersionCounts& counts) { return counts.broken; }},
    VersionMeasure{"both", "both fail", [](const VersionCounts& counts) { return counts.both; }},
    VersionMeasure{"neither", "", [](const VersionCounts& counts) { return counts.neither; }},
    VersionMeasure{"queries", "", [](const VersionCounts& counts) { return counts.queries(); }},
};

using Versions = std::pair<std::string, std::string>;  // before and after
using Part = std::pair<QueryClass, Kind>;
using Parts = std::map<Part, VersionCounts>;

std::map<Versions, Parts> by_class_and_kind(const VersionTable& table) {
  std::map<Versions, Parts> sums;
  for (const auto& [key, counts] : table)
    sums[{key.before, key.after}][{class_of(key.family), key.kind}].merge(counts);
  return sums;
}

/// "12 fixed, 3 broken"
std::string in_words(const VersionCounts& counts, bool shows_zeros) {
  std::vector<std::string> words;
  for (const VersionMeasure& each : measures)
    if (const std::uint64_t value = each.value(counts); !each.text.empty() && (value != 0 || shows_zeros))
      words.push_back(fmt::format("{} {}", with_separators(value), each.text));
  return fmt::format("{}", fmt::join(words, ", "));
}

/// Whether a subject was asked any queries of a kind; queries that its contract excludes do not count.
bool was_asked(const std::string& subject, Kind kind, const Statistics& statistics) {
  return std::any_of(statistics.counts.begin(), statistics.counts.end(), [&](const auto& each) {
    const auto& [key, counts] = each;
    return key.subject == subject && key.kind == kind &&
           counts.queries > counts.without_answer(Fault::contract) + counts.without_answer(Fault::not_asked);
  });
}

/// "; ee not compared, because old was not asked about it", for each kind that only one of the two versions
/// was asked.
std::string not_compared(const Versions& versions, const Parts& parts, const Statistics& statistics) {
  std::map<Kind, std::uint64_t> compared;
  for (const auto& [part, counts] : parts) compared[part.second] += counts.queries();
  std::string text;
  for (const auto& [kind, queries] : compared) {
    const bool before = was_asked(versions.first, kind, statistics);
    const bool after = was_asked(versions.second, kind, statistics);
    if (queries == 0 && before != after)
      text += fmt::format("; {} not compared, because {} was not asked about it", short_name(kind),
                          before ? versions.second : versions.first);
  }
  return text;
}

}  // namespace

std::string version_lines(const Statistics& statistics) {
  std::string lines;
  for (const auto& [versions, parts] : by_class_and_kind(statistics.versions)) {
    VersionCounts sum;
    std::vector<std::string> words;
    for (const auto& [part, counts] : parts) {
      sum.merge(counts);
      if (const std::string own = in_words(counts, false); !own.empty())
        words.push_back(fmt::format("{} {} {}", name(part.first), short_name(part.second), own));
    }
    if (sum.queries() == 0) {
      lines += fmt::format("{} against {}: no query was asked of both{}\n", versions.second, versions.first,
                           not_compared(versions, parts, statistics));
      continue;
    }
    lines += fmt::format("{} against {}: {}, of {}{}{}\n", versions.second, versions.first,
                         in_words(sum, true), counted(sum.queries(), "query", "queries"),
                         words.empty() ? "" : fmt::format(" ({})", fmt::join(words, "; ")),
                         not_compared(versions, parts, statistics));
  }
  return lines;
}

nlohmann::ordered_json versions_json(const Statistics& statistics) {
  auto json = nlohmann::ordered_json::array();
  for (const auto& [versions, parts] : by_class_and_kind(statistics.versions)) {
    const bool compares =
        std::any_of(parts.begin(), parts.end(), [](const auto& part) { return part.second.queries() != 0; });
    for (const auto& [part, counts] : parts) {
      if (compares && counts.queries() == 0) continue;
      json.push_back({{"before", versions.first},
                      {"after", versions.second},
                      {"kind", short_name(part.second)},
                      {"class", name(part.first)}});
      for (const VersionMeasure& each : measures) json.back()[std::string(each.key)] = each.value(counts);
    }
  }
  return json;
}

}  // namespace nearmiss
