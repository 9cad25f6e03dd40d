#include "reports/sections/measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "corpus/query_text.hpp"
#include "reports/statistics/confidence.hpp"
#include "reports/text/json.hpp"

namespace nearmiss {

namespace {

Value as_value(std::uint64_t count) { return count; }
Value as_value(double number) { return number; }
Value as_value(const std::optional<double>& number) { return number ? Value(*number) : Value(); }
Value as_value(DistanceUnit unit) { return name(unit); }
Value as_value(TimeSort sort) { return name(sort); }

template <auto member>
Value of(const CountsSum& sum) {
  return as_value(std::invoke(member, sum.counts));
}

/// The bin of a quantile. `quantile` is the member function of Counts that computes it.
template <auto quantile, int hundredths>
Value quantile_of(const CountsSum& sum) {
  return std::invoke(quantile, sum.counts, hundredths / 100.0);
}

Value far_travelled(const CountsSum& sum) { return sum.counts.travelled.quantile(0.99); }

Value ns_per_query(const CountsSum& sum) { return as_value(sum.counts.times.ns_per_query()); }

template <int hundredths>
Value ns_of_single(const CountsSum& sum) {
  return as_value(sum.counts.times.each.quantile(hundredths / 100.0));
}

Value invalid_answers(const CountsSum& sum) { return sum.counts.without_answer(Fault::invalid); }

Value upper_bound_of_misses(const CountsSum& sum) {
  if (!sum.is_sample) return {};
  return clopper_pearson_upper(sum.counts.false_negatives, sum.counts.collisions);
}

/// The 95 % confidence interval of a rate; nothing if the queries are not a random sample.
template <auto count, auto total>
Value interval(const CountsSum& sum) {
  if (!sum.is_sample) return {};
  const auto [lo, hi] = clopper_pearson(std::invoke(count, sum.counts), std::invoke(total, sum.counts));
  return Bin{lo, hi};
}

/// The number of late times; "-" if no time was promised to be a lower bound.
std::string late_text(const CountsSum& sum) {
  return sum.counts.times_promised == 0 ? "-" : with_separators(sum.counts.late);
}

/// The number of sound times for which the rounded step has contact (Counts::committed); "-" if no time was
/// promised to be a lower bound.
std::string committed_text(const CountsSum& sum) {
  return sum.counts.times_promised == 0 ? "-" : with_separators(sum.counts.committed);
}

std::string time_text(const CountsSum& sum) { return whole_ns(sum.counts.times.ns_per_query()); }

std::string farthest_text(const CountsSum& sum) {
  return marked_fraction_of_bound(sum.counts.max_ratio(), sum.counts.distance_unit());
}

constexpr std::array measures_of_every_sum{
    Measure{"queries", of<&Counts::queries>, "queries"},
    Measure{"collisions", of<&Counts::collisions>, "collisions"},
    Measure{"false_negatives", of<&Counts::false_negatives>, "false neg."},
    Measure{"false_negative_rate", of<&Counts::false_negative_rate>},
    Measure{"false_negative_rate_upper_95", upper_bound_of_misses, "rate below*", "false_negatives"},
    Measure{"false_negative_rate_interval_95", interval<&Counts::false_negatives, &Counts::collisions>},
    Measure{"false_positives", of<&Counts::false_positives>, "false pos."},
    Measure{"false_positive_rate", of<&Counts::false_positive_rate>, "rate", "false_positives"},
    Measure{"false_positive_rate_interval_95", interval<&Counts::false_positives, &Counts::others>},
    Measure{"refuted_bounds", of<&Counts::refuted_bounds>},
    Measure{"false_positives_measured_by_wang", of<&Counts::measured_by_wang>},
    Measure{"times_given", of<&Counts::times_given>, "times"},
    Measure{"times_promised", of<&Counts::times_promised>},
    Measure{"late", of<&Counts::late>, "late", "", late_text},
    Measure{"stuck", of<&Counts::stuck>, "stuck"},
    Measure{"committed", of<&Counts::committed>, "committed", "", committed_text},
    Measure{"unsafe_steps", of<&Counts::unsafe_steps>},
    Measure{"touch_at_end", of<&Counts::touch_at_end>, "at end"},
    Measure{"median_fp_distance_over_bound", quantile_of<&Counts::ratio_quantile, 50>, "", "refuted_bounds"},
    Measure{"q99_fp_distance_over_bound", quantile_of<&Counts::ratio_quantile, 99>, "", "refuted_bounds"},
    Measure{"max_fp_distance_over_bound", of<&Counts::max_ratio>, "max dist/bound", "refuted_bounds",
            farthest_text},
    Measure{"bound_of_distances", of<&Counts::distance_unit>},
    Measure{"unknown", of<&Counts::unknown>, "unknown", "stuck"},
    Measure{"time_sort", of<&Counts::time_sort>, "sort"},
    Measure{"median_early", quantile_of<&Counts::early_quantile, 50>, "early: median", "stuck"},
    Measure{"q99_early", quantile_of<&Counts::early_quantile, 99>, "99 %", "stuck"},
    Measure{"max_early", of<&Counts::max_early>, "most", "stuck"},
    Measure{"max_after", of<&Counts::max_after>, "after t*", "stuck"},
    Measure{"q99_travelled", far_travelled, "", "stuck"},
    Measure{"ns_per_query", ns_per_query, "ns/query", "refuted_bounds", time_text},
};

constexpr std::array other_measures{
    Measure{"without_answer", of<&Counts::faults_total>, "no answer"},
    Measure{"invalid", invalid_answers, "invalid"},
    Measure{"median_ns", ns_of_single<50>},
    Measure{"q99_ns", ns_of_single<99>},
    Measure{"median_time_error", quantile_of<&Counts::time_error_quantile, 50>},
    Measure{"q99_time_error", quantile_of<&Counts::time_error_quantile, 99>},
    Measure{"max_time_error", of<&Counts::max_time_error>},
};

/// The text of a value on the terminal; for a range, its upper end.
struct AsText {
  std::string operator()(std::monostate /*nothing*/) const { return "-"; }
  std::string operator()(std::uint64_t count) const { return with_separators(count); }
  std::string operator()(double number) const { return fmt::format("{:.2g}", number); }
  std::string operator()(const Bin& range) const { return fmt::format("{:.2g}", range.to); }
  std::string operator()(std::string_view word) const { return std::string(word); }
};

std::string text_of(const Measure& shown, const CountsSum& sum) {
  return shown.text == nullptr ? std::visit(AsText(), shown.value(sum)) : shown.text(sum);
}

}  // namespace

std::span<const Measure> rate_measures() { return measures_of_every_sum; }

const Measure& measure(std::string_view key) {
  const auto has_key = [&](const Measure& each) { return each.key == key; };
  for (const std::span<const Measure> list : {rate_measures(), std::span<const Measure>(other_measures)})
    if (const auto found = std::find_if(list.begin(), list.end(), has_key); found != list.end())
      return *found;
  throw std::out_of_range(fmt::format("no measure has the key {}", key));
}

std::vector<std::string> headings(std::vector<std::string> cells, const MeasureKeys& measures) {
  for (const std::string_view key : measures) cells.emplace_back(measure(key).heading);
  return cells;
}

std::vector<std::string> row_of(std::vector<std::string> cells, const MeasureKeys& measures,
                                const CountsSum& sum) {
  for (const std::string_view key : measures) cells.push_back(text_of(measure(key), sum));
  return cells;
}

using nlohmann::ordered_json;

ordered_json or_null(const std::optional<double>& number) {
  return number ? ordered_json(*number) : ordered_json();
}

namespace {

ordered_json value_json(std::uint64_t count) { return count; }

ordered_json value_json(const Histogram& histogram) { return histogram.bins; }

/// The cases as JSON. Each case has its `ratio` under `key`: "ratio" for a distance, "error" for a time.
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

/// A measure's value as JSON: null for no value; for a range, an array of both ends.
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
