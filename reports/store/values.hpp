// Conversion of values to and from the columns of a store: integers, reals, and text. from_stored reads what
// to_stored returns. It throws Error, with `where`, for anything else.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "reports/statistics/statistics.hpp"

namespace nearmiss {

// SQLite's integers are signed; a count never comes near 2^63.
inline std::int64_t to_stored(std::uint64_t count) { return static_cast<std::int64_t>(count); }
inline void from_stored(std::int64_t stored, std::uint64_t& count, const std::string& /*where*/) {
  count = static_cast<std::uint64_t>(stored);
}

inline std::int64_t to_stored(bool flag) { return flag ? 1 : 0; }
inline void from_stored(std::int64_t stored, bool& flag, const std::string& /*where*/) { flag = stored != 0; }

inline double to_stored(double number) { return number; }
inline void from_stored(double stored, double& number, const std::string& /*where*/) { number = stored; }

inline std::string to_stored(const std::string& text) { return text; }
inline void from_stored(const std::string& stored, std::string& text, const std::string& /*where*/) {
  text = stored;
}

std::string to_stored(Kind kind);
void from_stored(const std::string& stored, Kind& kind, const std::string& where);

std::string to_stored(Finding::What what);
void from_stored(const std::string& stored, Finding::What& what, const std::string& where);

std::string to_stored(QueryClass of);
void from_stored(const std::string& stored, QueryClass& of, const std::string& where);

std::string to_stored(Extreme::Of of);
void from_stored(const std::string& stored, Extreme::Of& of, const std::string& where);

/// The kind, and a line of 24 numbers.
std::string to_stored(const Query& query);
void from_stored(const std::string& stored, Query& query, const std::string& where);

std::string to_stored(const Histogram& histogram);
void from_stored(const std::string& stored, Histogram& histogram, const std::string& where);

std::string to_stored(const TimeHistogram& histogram);
void from_stored(const std::string& stored, TimeHistogram& histogram, const std::string& where);

std::string to_stored(const BatchesByFamily& batches);
void from_stored(const std::string& stored, BatchesByFamily& batches, const std::string& where);

std::string to_stored(const std::vector<FarCase>& cases);
void from_stored(const std::string& stored, std::vector<FarCase>& cases, const std::string& where);

std::string to_stored(const std::vector<SlowCase>& cases);
void from_stored(const std::string& stored, std::vector<SlowCase>& cases, const std::string& where);

template <std::size_t size>
std::string to_stored(const std::array<std::uint64_t, size>& counts) {
  return nlohmann::json(counts).dump();
}
template <std::size_t size>
void from_stored(const std::string& stored, std::array<std::uint64_t, size>& counts,
                 const std::string& /*where*/) {
  nlohmann::json::parse(stored).get_to(counts);
}

inline std::string to_stored(const std::map<std::string, std::string>& facts) {
  return nlohmann::json(facts).dump();
}
inline void from_stored(const std::string& stored, std::map<std::string, std::string>& facts,
                        const std::string& /*where*/) {
  facts = nlohmann::json::parse(stored).get<std::map<std::string, std::string>>();
}

}  // namespace nearmiss
