#include "reports/sections/counts_json.hpp"

#include <string>
#include <utility>

#include "corpus/query_text.hpp"
#include "reports/text/json.hpp"

namespace nearmiss {

using nlohmann::ordered_json;

ordered_json or_null(const std::optional<double>& number) {
  return number ? ordered_json(*number) : ordered_json();
}

namespace {

ordered_json value_json(std::uint64_t count) { return count; }

ordered_json value_json(const Histogram& histogram) { return histogram.bins; }

/// The cases as JSON. Each has its `ratio` under `key`, which names the quantity in which the cases are
/// extreme.
ordered_json cases_json(const std::vector<FarCase>& cases, const char* key) {
  ordered_json json = ordered_json::array();
  for (const FarCase& far : cases)
    json.push_back({{key, far.ratio}, {"provenance", far.provenance}, {"query", to_line(far.query)}});
  return json;
}

/// A subject's run times, except ns_per_query.
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
  ordered_json& object = counter.json_object.empty() ? json : json[std::string(counter.json_object)];
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

/// A measure's value as JSON: null if there is none; for a range, an array of both ends.
struct AsJson {
  ordered_json operator()(std::monostate /*nothing*/) const { return nullptr; }
  ordered_json operator()(const Bin& range) const { return ordered_json::array({range.from, range.to}); }
  template <class Simple>
  ordered_json operator()(const Simple& value) const {
    return value;
  }
};

void add_measure(ordered_json& json, const Measure& shown, const CountsSum& sum) {
  json[std::string(shown.key)] = std::visit(AsJson(), shown.value(sum));
}

}  // namespace

void add_measures(ordered_json& json, const MeasureKeys& measures, const CountsSum& sum) {
  for (const std::string_view key : measures) add_measure(json, measure(key), sum);
}

ordered_json rates_json(const CountsSum& sum) {
  ordered_json json;
  for (const Measure& each : rate_measures()) add_measure(json, each, sum);
  return json;
}

ordered_json counts_json(const CountsSum& sum) {
  ordered_json json = rates_json(sum);
  for_each_counter<Counts>([&](const auto& counter) {
    if (!json.contains(std::string(counter.json_key))) add_counter(json, sum.counts, counter);
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
