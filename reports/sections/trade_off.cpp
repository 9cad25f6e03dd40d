#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "reports/sections/counts_json.hpp"
#include "reports/sections/ladder.hpp"
#include "reports/sections/sections.hpp"
#include "reports/text/json.hpp"

namespace nearmiss {

namespace {

/// Run time and error of a subject, over the kinds and families that all compared subjects were asked about.
struct TradeOff {
  std::string subject;
  /// The sum over timed families. Rates come from it, too: only the families of directed searches have no
  /// meaningful rates, and these are not timed.
  CountsSum timed;
  CountsSum all;
  LadderPlace place;

  /// Distance of the subject's farthest false positive in units of B; nothing if the unit is not known.
  [[nodiscard]] std::optional<double> farthest() const {
    if (all.counts.false_positives == 0) return 0;
    return place.unit ? std::optional(all.counts.max_ratio() * *place.unit) : std::nullopt;
  }

  /// Whether the subject may be on a front: it has no failure, except failures that count only on request.
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

/// The largest set of subjects that were asked about a common family. If there are several such sets, the one
/// with the most common families.
Subjects most_comparable(const std::map<std::pair<Kind, std::string>, Subjects>& asked) {
  std::map<Subjects, std::size_t> sets;
  for (const auto& [family, subjects] : asked) ++sets[subjects];
  const auto most = std::max_element(sets.begin(), sets.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first.size(), a.second) < std::pair(b.first.size(), b.second);
  });
  return most == sets.end() ? Subjects() : most->first;
}

/// A TradeOff for each timed subject, in the order of their names, except subjects beyond their contracts.
/// If the subjects have no family in common, only those of most_comparable() have a TradeOff.
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
/// errors, only the first by name is on the front. `error` computes the error of a subject.
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

}  // namespace nearmiss
