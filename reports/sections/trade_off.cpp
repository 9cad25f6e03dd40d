#include "reports/sections/sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "reports/sections/measures.hpp"
#include "reports/statistics/family.hpp"
#include "reports/statistics/sums.hpp"
#include "reports/text/json.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

/// Run time and error of a subject, over the kinds and families that all compared subjects were asked about.
struct TradeOff {
  std::string subject;
  /// The sum over the families that were timed. Run times and rates are computed from this sum. The sum
  /// leaves out the families of directed searches, because they are not timed, and their rates have no
  /// meaning.
  CountsSum timed;
  CountsSum all;
  LadderPlace place;

  /// Distance of the subject's farthest false positive in units of B, the size of a pair; nothing if the
  /// bound by which the subject's distances are divided is not known.
  [[nodiscard]] std::optional<double> farthest() const {
    if (all.counts.false_positives == 0) return 0;
    return place.unit ? std::optional(all.counts.max_ratio() * *place.unit) : std::nullopt;
  }

  /// Whether the subject may be on a Pareto front: it has no failures, except those that count only on
  /// request.
  [[nodiscard]] bool sound() const {
    return in_common(failures_of(subject, all.counts), usual_failures()).empty();
  }
};

using Subjects = std::set<std::string>;

bool is_timed(const Counts& counts) { return counts.times.queries() != 0; }

Subjects timed_subjects(const Statistics& statistics) {
  Subjects subjects;
  for (const auto& [key, counts] : statistics.counts)
    if (is_timed(counts) && !is_beyond_contract(key.subject)) subjects.insert(key.subject);
  return subjects;
}

/// Maps each kind and family to the timed subjects that were asked about it.
std::map<std::pair<Kind, std::string>, Subjects> asked_subjects(const Statistics& statistics) {
  const Subjects timed = timed_subjects(statistics);
  std::map<std::pair<Kind, std::string>, Subjects> asked;
  for (const auto& [key, counts] : statistics.counts)
    if (timed.contains(key.subject)) asked[{key.kind, key.family}].insert(key.subject);
  return asked;
}

/// The largest set of subjects that were asked about the same family. If several sets are equally large,
/// returns the set whose subjects were asked about the most families together.
Subjects most_comparable(const std::map<std::pair<Kind, std::string>, Subjects>& asked) {
  std::map<Subjects, std::size_t> sets;
  for (const auto& [family, subjects] : asked) ++sets[subjects];
  const auto most = std::max_element(sets.begin(), sets.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first.size(), a.second) < std::pair(b.first.size(), b.second);
  });
  return most == sets.end() ? Subjects() : most->first;
}

/// A TradeOff for each timed subject, in the order of names, except subjects beyond their contracts. If there
/// is no family about which all these subjects were asked, only the subjects of most_comparable() have a
/// TradeOff.
std::vector<TradeOff> trade_offs(const Statistics& statistics) {
  const auto asked = asked_subjects(statistics);
  const Subjects subjects = most_comparable(asked);
  std::map<std::string, CountsSum> all;
  std::map<std::string, CountsSum> timed;
  for (const auto& [key, counts] : statistics.counts) {
    const auto family = asked.find({key.kind, key.family});
    if (family == asked.end() || !subjects.contains(key.subject) ||
        !std::includes(family->second.begin(), family->second.end(), subjects.begin(), subjects.end()))
      continue;
    all[key.subject].add(key.family, counts);
    if (is_timed(counts)) timed[key.subject].add(key.family, counts);
  }
  std::vector<TradeOff> trade_offs;
  for (const auto& [subject, counts] : timed)
    trade_offs.push_back({subject, counts, all.at(subject), place_of(subject)});
  return trade_offs;
}

/// The Pareto front of the sound subjects, fastest first. A sound subject is on the front unless another
/// sound subject is at least as fast and has at most the same error. If several subjects have equal times and
/// errors, only the first by name is on the front.
std::vector<std::string> pareto_front(const std::vector<TradeOff>& all, double (*error)(const TradeOff&)) {
  std::vector<const TradeOff*> sound;
  for (const TradeOff& each : all)
    if (each.sound()) sound.push_back(&each);
  std::stable_sort(sound.begin(), sound.end(), [&](const TradeOff* a, const TradeOff* b) {
    return std::pair(a->timed.counts.times.ns_per_query(), error(*a)) <
           std::pair(b->timed.counts.times.ns_per_query(), error(*b));
  });
  std::vector<std::string> front;
  double least = std::numeric_limits<double>::infinity();
  for (const TradeOff* each : sound) {
    if (error(*each) >= least) continue;
    least = error(*each);
    front.push_back(each->subject);
  }
  return front;
}

bool has_ladder(const std::vector<TradeOff>& all) {
  std::map<std::string, std::set<std::string>> scalars;
  for (const TradeOff& each : all) scalars[each.place.algorithm].insert(each.place.scalar);
  return std::any_of(scalars.begin(), scalars.end(), [](const auto& each) { return each.second.size() > 2; });
}

/// The Pareto front by earliness, among the subjects whose times are lower bounds.
std::vector<std::string> front_by_earliness(std::vector<TradeOff> all) {
  std::erase_if(all, [](const TradeOff& each) { return !is_lower_bound(each.timed.counts.time_sort()); });
  return pareto_front(all, [](const TradeOff& each) { return each.timed.counts.early_quantile(0.99).to; });
}

nlohmann::ordered_json ladder_of(std::vector<TradeOff> all) {
  std::erase_if(all, [](const TradeOff& each) { return !each.farthest(); });
  nlohmann::ordered_json json;
  json["front_by_distance"] = pareto_front(all, [](const TradeOff& each) { return *each.farthest(); });
  json["paper_bound"] = *place_of("wang").unit;
  return json;
}

}  // namespace

nlohmann::ordered_json trade_offs_json(const Statistics& statistics) {
  const auto all = trade_offs(statistics);
  nlohmann::ordered_json json;
  json["subjects"] = nlohmann::ordered_json::object();
  const MeasureKeys of_all{"collisions",
                           "false_negatives",
                           "max_fp_distance_over_bound",
                           "bound_of_distances",
                           "times_given",
                           "times_promised",
                           "late"};
  for (const TradeOff& each : all) {
    auto& subject = json["subjects"][each.subject] = rates_json(each.timed);
    add_measures(subject, of_all, each.all);
    add_measures(subject, {"median_time_error", "q99_time_error"}, each.timed);
    add_measures(subject, {"max_time_error"}, each.all);
    subject["sound"] = each.sound();
    subject.update(place_json(each.place));
    subject["farthest_over_B"] = or_null(each.farthest());
  }
  json["left_out"] = nlohmann::ordered_json::array();
  for (const std::string& subject : timed_subjects(statistics))
    if (!json["subjects"].contains(subject)) json["left_out"].push_back(subject);
  json["front_by_distance"] =
      pareto_front(all, [](const TradeOff& each) { return each.all.counts.max_ratio(); });
  json["front_by_rate"] =
      pareto_front(all, [](const TradeOff& each) { return each.timed.counts.false_positive_rate(); });
  json["front_by_earliness"] = front_by_earliness(all);
  if (has_ladder(all)) json["ladder"] = ladder_of(all);
  return json;
}

namespace {

constexpr std::array references{"wang", "exact"};

constexpr std::size_t decider_count = 4;

/// Names of the deciders in files, in the order in which a subject asks them. If the stage or the rejection
/// of an answer has one of the last three names, the decider with this name decided the query. Otherwise
/// "algorithm" decided it.
constexpr std::array<std::string_view, decider_count> decider_names{"algorithm", "filter", "finer", "exact"};

/// How many queries of a family, of all kinds together, each decider of a subject decided.
struct DeciderRow {
  std::string subject;
  std::string family;  ///< "" for all families; all steps of a scene count as one family
  std::array<std::uint64_t, decider_count> queries{};
  std::optional<double> ns_per_query;  ///< nothing if the subject was not timed
  /// Maps "wang" and "exact" to the subject's run time divided by that of the named subject, over the
  /// families and kinds in which both were timed.
  std::map<std::string, double> time_over;

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

/// The run time of a subject divided by the run time of another subject. Includes the kinds and families for
/// which `is_shown` is true and both subjects have times. Returns nothing if there is no such kind and
/// family.
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

/// The row of a subject for a family, or for all families if `family` is "".
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

/// Rows for each subject whose algorithm decides some queries and leaves other queries to another decider:
/// one row for all families, then one row for each family.
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
