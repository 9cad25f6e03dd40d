// Functions that convert a campaign's values to JSON and back, in the form that the JSON library expects.
// from_json restores exactly what to_json wrote; for anything else it throws Error, or an exception of the
// library.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "ccd/query/error.hpp"
#include "corpus/query_text.hpp"
#include "reports/campaign/campaign.hpp"
#include "reports/campaign/finding_case.hpp"
#include "reports/text/json.hpp"

namespace nearmiss {

inline constexpr auto kind_names = [] {
  std::array<std::string_view, kinds.size()> names;
  for (const Kind kind : kinds) names[static_cast<std::size_t>(kind)] = short_name(kind);
  return names;
}();
/// The names of the enumerators of a type, in the order of the enumeration.
constexpr const auto& names_of(Kind) { return kind_names; }
constexpr const auto& names_of(Finding::What) { return what_names; }
constexpr const auto& names_of(QueryClass) { return class_names; }
constexpr const auto& names_of(Extreme::Of) { return extreme_names; }

template <class Enum>
requires requires(Enum each) { names_of(each); }
void to_json(nlohmann::json& json, const Enum& each) {
  json = names_of(each)[static_cast<std::size_t>(each)];
}

template <class Enum>
requires requires(Enum each) { names_of(each); }
void from_json(const nlohmann::json& json, Enum& each) {
  const auto& names = names_of(each);
  const auto text = json.get<std::string>();
  const auto name = std::find(names.begin(), names.end(), text);
  if (name == names.end()) throw Error(fmt::format("found '{}', which this version does not know", text));
  each = static_cast<Enum>(name - names.begin());
}

/// A query becomes a text: its kind, then its numbers, as in a line of a query file.
inline void to_json(nlohmann::json& json, const Query& query) {
  json = fmt::format("{} {}", short_name(query.kind), to_line(query));
}
inline void from_json(const nlohmann::json& json, Query& query) {
  const auto text = json.get<std::string>();
  const auto end_of_kind = std::min(text.find(' '), text.size());
  query = parse_line(parse_kind(text.substr(0, end_of_kind), "query"), text.substr(end_of_kind), "query");
}

inline void to_json(nlohmann::json& json, const BatchTimes& times) { json = times.bins(); }
inline void from_json(const nlohmann::json& json, BatchTimes& times) {
  times = BatchTimes(json.get<BatchTimes::Bins>());
}

/// The member `value` becomes text, because it may be infinite, which JSON cannot express.
inline void to_json(nlohmann::json& json, const Extreme& extreme) {
  json = {{"of", extreme.of},           {"name", extreme.name},
          {"query", extreme.query},     {"value", fmt::format("{}", extreme.value)},
          {"queries", extreme.queries}, {"provenance", extreme.provenance}};
}
inline void from_json(const nlohmann::json& json, Extreme& extreme) {
  json.at("of").get_to(extreme.of);
  json.at("name").get_to(extreme.name);
  const auto value = json.at("value").get<std::string>();
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), extreme.value);
  if (error != std::errc() || end != value.data() + value.size() || std::isnan(extreme.value))
    throw Error(fmt::format("found '{}', expected a number", value));
  json.at("query").get_to(extreme.query);
  json.at("provenance").get_to(extreme.provenance);
  json.at("queries").get_to(extreme.queries);
}

/// Throws Error if a count is larger than any sum of counts can be.
template <class Counted>
void expect_counted(const Counted& counted) {
  if constexpr (std::is_same_v<Counted, std::uint64_t>) {
    if (counted > largest_count)
      throw Error(fmt::format("found the count {}, expected at most 2^60", counted));
  } else if constexpr (requires { std::tuple_size<Counted>::value; }) {
    for (const auto& each : counted) expect_counted(each);
  }
}

/// Counters become an object with their names as keys.
template <class Owner>
requires requires { Owner::counters(); }
void to_json(nlohmann::json& json, const Owner& owner) {
  for_each_counter<Owner>([&](const auto& counter) { json[counter.name] = owner.*counter.member; });
}
template <class Owner>
requires requires { Owner::counters(); }
void from_json(const nlohmann::json& json, Owner& owner) {
  for_each_counter<Owner>([&](const auto& counter) {
    json.at(counter.name).get_to(owner.*counter.member);
    expect_counted(owner.*counter.member);
  });
  if constexpr (requires { owner.is_possible(); })
    if (!owner.is_possible()) throw Error("found a counter that exceeds the one of which it counts a part");
}

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Histogram, bins)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TimeHistogram, bins)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FarCase, ratio, query, provenance)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SlowCase, nanoseconds, query, provenance)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CountsKey, subject, kind, family)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FactorKey, subject, kind, family, values)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SimulatedStepKey, family, subject, step)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(VersionKey, before, after, kind, family)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Signature, what, subject, text)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Shard, index, count, cases, complete, started, seconds, environment)

/// The members that every finding has in a store.
struct FindingWithoutErrors : Finding {};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FindingWithoutErrors, what, subject, family, query, provenance, ratio,
                                   signature, shrunk, place, time, is_shrunk, query_class, simplest,
                                   simplest_class, broken_since, bound, step, certificate)

/// Each line of `errors` becomes a separate text, because texts in a store have no line ends.
inline void to_json(nlohmann::json& json, const Finding& finding) {
  json = FindingWithoutErrors{finding};
  if (!finding.errors.empty()) json["errors"] = error_lines(finding);
}
inline void from_json(const nlohmann::json& json, Finding& finding) {
  finding = json.get<FindingWithoutErrors>();
  for (const auto& line : json.value("errors", std::vector<std::string>())) finding.errors += line + "\n";
}

}  // namespace nearmiss
