#include "reports/sections/counts_json.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <utility>

#include "corpus/query_text.hpp"
#include "reports/statistics/confidence.hpp"

namespace nearmiss {

using nlohmann::ordered_json;

ordered_json or_null(const std::optional<double>& number) {
  return number ? ordered_json(*number) : ordered_json();
}

namespace {

ordered_json value_json(std::uint64_t count) { return count; }

ordered_json value_json(const Histogram& histogram) { return histogram.bins; }

/// `key` names what the cases are extreme in.
ordered_json cases_json(const std::vector<FarCase>& cases, const char* key) {
  ordered_json json = ordered_json::array();
  for (const FarCase& far : cases)
    json.push_back({{key, far.ratio}, {"provenance", far.provenance}, {"query", to_line(far.query)}});
  return json;
}

/// All times except ns_per_query.
ordered_json value_json(const SubjectTimes& times) {
  ordered_json json;
  json["timed_queries"] = times.queries();
  if (const auto mean = times.mean()) json["mean_ns"] = *mean;
  json["sampled"] = times.each.total();
  if (times.each.total() == 0) return json;
  for (const auto& [name, part] : {std::pair{"median_ns", 0.5}, {"q99_ns", 0.99}, {"q99.9_ns", 0.999}})
    json[name] = or_null(times.each.quantile(part));
  for (const SlowCase& slow : times.slowest)
    json["slowest"].push_back(
        {{"ns", slow.nanoseconds}, {"provenance", slow.provenance}, {"query", to_line(slow.query)}});
  return json;
}

template <class Owner, class Member>
void add_counter(ordered_json& json, const Owner& owner, const Counter<Owner, Member>& counter) {
  ordered_json& object = counter.shown == Shown::in_times ? json["times"] : json;
  object[std::string(counter.json_key)] = value_json(owner.*counter.member);
}

void add_counter(ordered_json& json, const Counts& counts,
                 const Counter<Counts, std::vector<FarCase>>& counter) {
  const bool are_distances = counter.member == &Counts::farthest;
  json[std::string(counter.json_key)] = cases_json(counts.*counter.member, are_distances ? "ratio" : "error");
}

template <class Owner, std::size_t size>
void add_counter(ordered_json& json, const Owner& owner, const NamedCounts<Owner, size>& counter) {
  ordered_json named = ordered_json::object();
  for (std::size_t i = counter.first; i < size; ++i)
    if (const std::uint64_t count = (owner.*counter.member)[i]; count != 0 || counter.shows_zeros)
      named[std::string(counter.names[i])] = count;
  if (counter.json_key.empty())
    json.update(named);
  else
    json[std::string(counter.json_key)] = std::move(named);
}

template <class Owner>
void add_counters(ordered_json& json, const Owner& owner) {
  for_each_counter<Owner>([&](const auto& counter) { add_counter(json, owner, counter); });
}

/// The 95 % confidence interval of a rate; null unless the queries are a random sample.
ordered_json interval_json(std::uint64_t count, std::uint64_t total, bool is_sample) {
  if (!is_sample) return nullptr;
  const ConfidenceInterval interval = clopper_pearson(count, total);
  return ordered_json::array({interval.lo, interval.hi});
}

/// Adds the rates that are computed from this counter.
void add_computed(ordered_json& json, const Counts& counts, std::uint64_t Counts::*counter, bool is_sample) {
  if (counter == &Counts::false_negatives) {
    json["false_negative_rate"] = counts.false_negative_rate();
    json["false_negative_rate_upper_95"] = nullptr;
    if (is_sample)
      json["false_negative_rate_upper_95"] = clopper_pearson_upper(counts.false_negatives, counts.collisions);
    json["false_negative_rate_interval_95"] =
        interval_json(counts.false_negatives, counts.collisions, is_sample);
  }
  if (counter == &Counts::false_positives) {
    json["false_positive_rate"] = counts.false_positive_rate();
    json["false_positive_rate_interval_95"] =
        interval_json(counts.false_positives, counts.others(), is_sample);
  }
}

template <class Declared>
constexpr bool stands_with_rates(const Declared& counter) {
  if constexpr (requires { counter.shown; }) return counter.shown == Shown::with_rates;
  return false;
}

}  // namespace

ordered_json rates_json(const Counts& counts, bool is_sample) {
  ordered_json json;
  for_each_counter<Counts>([&](const auto& counter) {
    if (!stands_with_rates(counter)) return;
    add_counter(json, counts, counter);
    if constexpr (std::is_same_v<decltype(counter.member), std::uint64_t Counts::*>)
      add_computed(json, counts, counter.member, is_sample);
  });
  const auto range = [](const Bin& bin) { return ordered_json{bin.from, bin.to}; };
  json["median_fp_distance_over_bound"] = range(counts.ratio_quantile(0.5));
  json["q99_fp_distance_over_bound"] = range(counts.ratio_quantile(0.99));
  json["max_fp_distance_over_bound"] = counts.max_ratio();
  json["bound_of_distances"] = name(counts.distance_unit());
  json["unknown"] = counts.unknown();
  json["time_sort"] = name(counts.time_sort());
  json["median_early"] = range(counts.early_quantile(0.5));
  json["q99_early"] = range(counts.early_quantile(0.99));
  json["max_early"] = counts.max_early();
  json["max_after"] = counts.max_after();
  json["q99_travelled"] = range(counts.travelled.quantile(0.99));
  json["ns_per_query"] = or_null(counts.times.ns_per_query());
  return json;
}

ordered_json counts_json(const Counts& counts, bool is_sample) {
  ordered_json json = rates_json(counts, is_sample);
  for_each_counter<Counts>([&](const auto& counter) {
    if (!stands_with_rates(counter)) add_counter(json, counts, counter);
  });
  return json;
}

ordered_json oracle_json(const OracleCounts& counts) {
  ordered_json json;
  add_counters(json, counts);
  return json;
}

ordered_json funnel_json(const Funnel& funnel) {
  ordered_json json{{"all", funnel.all()}};
  add_counters(json, funnel);
  return json;
}

void add_campaign_counters(ordered_json& json, const Statistics& statistics) {
  add_counters(json, statistics);
}

}  // namespace nearmiss
