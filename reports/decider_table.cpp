#include "reports/decider_table.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <utility>

#include "reports/family.hpp"
#include "reports/funnel.hpp"
#include "reports/text.hpp"

namespace nearmiss {

namespace {

constexpr std::array references{"wang", "exact"};

using Deciders = std::array<std::uint64_t, decider_count>;

Deciders deciders(const Counts& counts) {
  const auto hits = [&](Stage stage) {
    const auto i = static_cast<std::size_t>(stage);
    return counts.true_by_stage[i] + counts.false_by_stage[i];
  };
  const auto rejections = [&](Rejection by) { return counts.rejected_by[static_cast<std::size_t>(by)]; };
  const std::uint64_t filter = hits(Stage::filter) + rejections(Rejection::filter);
  const std::uint64_t finer = rejections(Rejection::finer);
  const std::uint64_t exact = hits(Stage::exact) + rejections(Rejection::exact);
  return {counts.queries - counts.faults_total() - filter - finer - exact, filter, finer, exact};
}

bool ask_others(const Deciders& queries) {
  return queries[0] != 0 && std::accumulate(queries.begin() + 1, queries.end(), std::uint64_t{0}) != 0;
}

std::string row_family(const std::string& family) {
  return family.starts_with("scene:") ? scene_of(family) : std::string(shown_family(family));
}

/// The time of a subject over that of another, of the keys that are `shown` and timed for both; nothing where
/// there are none.
template <class Shown>
std::optional<double> time_over(const Statistics& statistics, const std::string& subject,
                                const std::string& other, const Shown& shown) {
  Counts own;
  Counts others;
  for (const auto& [key, counts] : statistics.counts) {
    if (key.subject != subject || !shown(key) || counts.times.queries() == 0) continue;
    const auto same = statistics.counts.find({other, key.kind, key.family});
    if (same == statistics.counts.end() || same->second.times.queries() == 0) continue;
    own.merge(counts);
    others.merge(same->second);
  }
  if (others.times.queries() == 0) return std::nullopt;
  return own.times.ns_per_query() / others.times.ns_per_query();
}

DeciderRow row(const Statistics& statistics, const std::string& subject, const std::string& family) {
  const auto shown = [&](const Key& key) { return family.empty() || row_family(key.family) == family; };
  Counts sum;
  for (const auto& [key, counts] : statistics.counts)
    if (key.subject == subject && shown(key)) sum.merge(counts);
  DeciderRow result{subject, family, deciders(sum), std::nullopt, {}};
  if (sum.times.queries() != 0) result.ns_per_query = sum.times.ns_per_query();
  for (const std::string reference : references)
    if (const auto ratio = time_over(statistics, subject, reference, shown))
      result.time_over[reference] = *ratio;
  return result;
}

}  // namespace

std::uint64_t DeciderRow::all() const {
  return std::accumulate(queries.begin(), queries.end(), std::uint64_t{0});
}

std::vector<DeciderRow> decider_rows(const Statistics& statistics) {
  std::map<std::string, std::set<std::string>> families;
  for (const auto& each : statistics.counts)
    families[each.first.subject].insert(row_family(each.first.family));
  std::vector<DeciderRow> rows;
  for (const auto& [subject, names] : families) {
    DeciderRow all = row(statistics, subject, "");
    if (!ask_others(all.queries)) continue;
    rows.push_back(std::move(all));
    for (const std::string& family : names) rows.push_back(row(statistics, subject, family));
  }
  return rows;
}

std::string decider_tables(const Statistics& statistics) {
  std::map<std::string, std::vector<std::vector<std::string>>> tables;
  for (const DeciderRow& each : decider_rows(statistics)) {
    auto& table = tables[each.subject];
    if (table.empty()) {
      table.push_back({"decided by", "queries"});
      for (const auto name : decider_names) table.back().insert(table.back().end(), {std::string(name), ""});
      table.back().emplace_back("ns/query");
      for (const std::string reference : references) table.back().push_back("/ " + reference);
    }
    auto& cells = table.emplace_back();
    cells = {each.family.empty() ? "all families" : each.family, with_separators(each.all())};
    for (const std::uint64_t part : each.queries)
      cells.insert(cells.end(), {with_separators(part), percent(part, each.all())});
    cells.push_back(each.ns_per_query ? fmt::format("{:.0f}", *each.ns_per_query) : "-");
    for (const char* reference : references) {
      const auto ratio = each.time_over.find(reference);
      cells.push_back(ratio == each.time_over.end() ? "-" : fmt::format("{:.3g}", ratio->second));
    }
  }
  std::string text;
  for (const auto& [subject, table] : tables) text += fmt::format("\n{}\n{}", subject, columns(table, 1));
  return text;
}

nlohmann::ordered_json deciders_json(const Statistics& statistics) {
  auto json = nlohmann::ordered_json::array();
  for (const DeciderRow& each : decider_rows(statistics)) {
    nlohmann::ordered_json row{{"subject", each.subject}, {"family", each.family}, {"queries", each.all()}};
    for (std::size_t i = 0; i < decider_count; ++i)
      row["decided_by"][std::string(decider_names[i])] = each.queries[i];
    row["ns_per_query"] =
        each.ns_per_query ? nlohmann::ordered_json(*each.ns_per_query) : nlohmann::ordered_json();
    row["time_over"] = each.time_over;
    json.push_back(std::move(row));
  }
  return json;
}

}  // namespace nearmiss
