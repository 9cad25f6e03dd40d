#include <fmt/format.h>

#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "reports/sections/counts_json.hpp"
#include "reports/sections/sections.hpp"
#include "reports/statistics/family.hpp"
#include "reports/statistics/sums.hpp"
#include "reports/text/json.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

constexpr std::array references{"wang", "exact"};

constexpr std::size_t decider_count = 4;

/// Names of the deciders in files, in the order in which a subject asks them. A stage or rejection with one
/// of the last three names belongs to that decider; every other stage or rejection belongs to "algorithm".
constexpr std::array<std::string_view, decider_count> decider_names{"algorithm", "filter", "finer", "exact"};

/// A subject's queries of a family, all kinds together, by the decider that decided them.
struct DeciderRow {
  std::string subject;
  std::string family;  ///< "" for all families; a scene is one family with all its steps
  std::array<std::uint64_t, decider_count> queries{};
  std::optional<double> ns_per_query;       ///< nothing if the subject was not timed
  std::map<std::string, double> time_over;  ///< time divided by that of another subject, the key, over the
                                            ///< families and kinds that have both times

  [[nodiscard]] std::uint64_t all() const;
};

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
  return family.starts_with("scene:") ? scene_of(family) : shown_family(family);
}

/// The run time of a subject divided by that of another subject, over the kinds and families for which
/// `is_shown` is true and both have times; nothing if there are none.
template <class IsShown>
std::optional<double> time_over(const Statistics& statistics, const std::string& subject,
                                const std::string& other, const IsShown& is_shown) {
  Counts own;
  Counts others;
  for (const auto& [key, counts] : statistics.counts) {
    if (key.subject != subject || !is_shown(key) || counts.times.queries() == 0) continue;
    const auto same = statistics.counts.find({other, key.kind, key.family});
    if (same == statistics.counts.end() || same->second.times.queries() == 0) continue;
    own.merge(counts);
    others.merge(same->second);
  }
  const auto ns = own.times.ns_per_query();
  const auto ns_of_other = others.times.ns_per_query();
  return ns && ns_of_other ? std::optional(*ns / *ns_of_other) : std::nullopt;
}

/// The row of a subject for a family, or for all families if `family` is "". `sum` has the counters of the
/// row.
DeciderRow row(const Statistics& statistics, const std::string& subject, const std::string& family,
               const CountsSum& sum) {
  const auto shown = [&](const CountsKey& key) { return family.empty() || row_family(key.family) == family; };
  DeciderRow result{subject, family, deciders(sum.counts), sum.counts.times.ns_per_query(), {}};
  for (const std::string reference : references)
    if (const auto ratio = time_over(statistics, subject, reference, shown))
      result.time_over[reference] = *ratio;
  return result;
}

std::uint64_t DeciderRow::all() const {
  return std::accumulate(queries.begin(), queries.end(), std::uint64_t{0});
}

/// Rows for each subject whose algorithm decides some queries and leaves others to another decider: one row
/// for all families, then one for each family.
std::vector<DeciderRow> decider_rows(const Statistics& statistics) {
  const auto by_family = sums_by(
      statistics, [](const CountsKey& key) { return std::pair(key.subject, row_family(key.family)); });
  std::vector<DeciderRow> rows;
  for (const auto& [subject, all] : sums_by(statistics, &CountsKey::subject)) {
    if (!ask_others(deciders(all.counts))) continue;
    rows.push_back(row(statistics, subject, "", all));
    for (const auto& [key, sum] : by_family)
      if (key.first == subject) rows.push_back(row(statistics, subject, key.second, sum));
  }
  return rows;
}

std::vector<std::string> heading() {
  std::vector<std::string> cells{"decided by", "queries"};
  for (const auto name : decider_names) cells.insert(cells.end(), {std::string(name), ""});
  cells.emplace_back("ns/query");
  for (const std::string reference : references) cells.push_back("/ " + reference);
  return cells;
}

std::vector<std::string> cells_of(const DeciderRow& row) {
  std::vector<std::string> cells{row.family.empty() ? "all families" : row.family,
                                 with_separators(row.all())};
  for (const std::uint64_t queries : row.queries)
    cells.insert(cells.end(), {with_separators(queries), percent(queries, row.all())});
  cells.push_back(whole_ns(row.ns_per_query));
  for (const char* reference : references) {
    const auto ratio = row.time_over.find(reference);
    cells.push_back(ratio == row.time_over.end() ? "-" : fmt::format("{:.3g}", ratio->second));
  }
  return cells;
}

}  // namespace

std::string decider_tables(const Statistics& statistics) {
  std::map<std::string, std::vector<std::vector<std::string>>> tables;
  for (const DeciderRow& each : decider_rows(statistics))
    tables.try_emplace(each.subject, 1, heading()).first->second.push_back(cells_of(each));
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
    row["ns_per_query"] = or_null(each.ns_per_query);
    row["time_over"] = each.time_over;
    json.push_back(std::move(row));
  }
  return json;
}

}  // namespace nearmiss
