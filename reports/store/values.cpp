#include "reports/store/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "ccd/error.hpp"
#include "corpus/query_text.hpp"

namespace nearmiss {

using nlohmann::json;

namespace {

/// The enumerator that has this name.
template <class Enum, std::size_t size>
Enum named(const std::string& text, const std::array<std::string_view, size>& names,
           const std::string& where) {
  const auto name = std::find(names.begin(), names.end(), text);
  if (name == names.end())
    throw Error(fmt::format("{}: found '{}', which this version does not know", where, text));
  return static_cast<Enum>(name - names.begin());
}

Query parse_query(const std::string& text, const std::string& where) {
  const auto end_of_kind = std::min(text.find(' '), text.size());
  return parse_line(parse_kind(text.substr(0, end_of_kind), where), text.substr(end_of_kind), where);
}

}  // namespace

std::string to_stored(Kind kind) { return std::string(short_name(kind)); }
void from_stored(const std::string& stored, Kind& kind, const std::string& where) {
  kind = parse_kind(stored, where);
}

std::string to_stored(Finding::What what) { return std::string(name(what)); }
void from_stored(const std::string& stored, Finding::What& what, const std::string& where) {
  what = named<Finding::What>(stored, what_names, where);
}

std::string to_stored(QueryClass of) { return std::string(name(of)); }
void from_stored(const std::string& stored, QueryClass& of, const std::string& where) {
  of = named<QueryClass>(stored, class_names, where);
}

std::string to_stored(Extreme::Of of) { return std::string(name(of)); }
void from_stored(const std::string& stored, Extreme::Of& of, const std::string& where) {
  of = named<Extreme::Of>(stored, extreme_names, where);
}

std::string to_stored(const Query& query) {
  return fmt::format("{} {}", short_name(query.kind), to_line(query));
}
void from_stored(const std::string& stored, Query& query, const std::string& where) {
  query = parse_query(stored, where);
}

std::string to_stored(const Histogram& histogram) { return json(histogram.bins).dump(); }
void from_stored(const std::string& stored, Histogram& histogram, const std::string& /*where*/) {
  json::parse(stored).get_to(histogram.bins);
}

std::string to_stored(const TimeHistogram& histogram) { return json(histogram.bins).dump(); }
void from_stored(const std::string& stored, TimeHistogram& histogram, const std::string& /*where*/) {
  json::parse(stored).get_to(histogram.bins);
}

std::string to_stored(const BatchesByFamily& batches) {
  json list = json::array();
  for (const auto& [key, times] : batches) list.push_back({short_name(key.first), key.second, times.bins()});
  return list.dump();
}
void from_stored(const std::string& stored, BatchesByFamily& batches, const std::string& where) {
  for (const json& each : json::parse(stored))
    batches[{parse_kind(each.at(0).get<std::string>(), where), each.at(1).get<std::string>()}] =
        BatchTimes(each.at(2).get<BatchTimes::Bins>());
}

std::string to_stored(const std::vector<FarCase>& cases) {
  json list = json::array();
  for (const FarCase& far : cases) list.push_back({to_hex(far.ratio), far.provenance, to_stored(far.query)});
  return list.dump();
}
void from_stored(const std::string& stored, std::vector<FarCase>& cases, const std::string& where) {
  for (const json& each : json::parse(stored))
    cases.push_back({parse_number(each.at(0).get<std::string>(), where),
                     parse_query(each.at(2).get<std::string>(), where), each.at(1).get<std::string>()});
}

std::string to_stored(const std::vector<SlowCase>& cases) {
  json list = json::array();
  for (const SlowCase& slow : cases)
    list.push_back({slow.nanoseconds, slow.provenance, to_stored(slow.query)});
  return list.dump();
}
void from_stored(const std::string& stored, std::vector<SlowCase>& cases, const std::string& where) {
  for (const json& each : json::parse(stored))
    cases.push_back({each.at(0).get<std::uint64_t>(), parse_query(each.at(2).get<std::string>(), where),
                     each.at(1).get<std::string>()});
}

}  // namespace nearmiss
