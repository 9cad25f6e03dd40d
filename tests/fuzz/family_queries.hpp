// Makes the first queries of a family, and counts those that have a property.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/families/families.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

inline void PrintTo(const Family& family, std::ostream* out) { *out << family.name; }

}  // namespace nearmiss

namespace nearmiss::testing {

inline std::string name_of_test(const ::testing::TestParamInfo<Family>& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// How many queries of each family to test: `usual`, unless the environment variable NEARMISS_QUERIES gives
/// another number for a long run by hand.
inline std::uint64_t query_count(std::uint64_t usual) {
  const char* const given = std::getenv("NEARMISS_QUERIES");
  return given == nullptr ? usual : std::stoull(given);
}

/// How many of the first 400 queries of a family, with seed 5, have a property. `nearmiss family NAME --seed
/// 5` prints these queries.
template <class Property>
int count_of_400(std::string_view name, const Property& has_property) {
  const Family family = find_family(name);
  int count = 0;
  for (std::uint64_t i = 0; i < 400; ++i) count += has_property(nearmiss::make_query(family, 5, i)) ? 1 : 0;
  return count;
}

template <class Property>
void expect_count(std::string_view name, int above, int below, const Property& has_property) {
  const int count = count_of_400(name, has_property);
  EXPECT_GT(count, above) << name;
  EXPECT_LT(count, below) << name;
}

template <class Property>
void expect_more(std::string_view name, int above, const Property& has_property) {
  EXPECT_GT(count_of_400(name, has_property), above) << name;
}

template <class Property>
void expect_all(std::string_view name, const Property& has_property) {
  EXPECT_EQ(count_of_400(name, has_property), 400) << name;
}

inline std::string at(const std::string& family, int x) { return family + "@" + std::to_string(x); }

inline std::vector<Query> first_queries(std::string_view name, std::uint64_t count, std::uint64_t seed = 1) {
  const Family family = find_family(name);
  std::vector<Query> queries;
  for (std::uint64_t i = 0; i < count; ++i) queries.push_back(nearmiss::make_query(family, seed, i));
  return queries;
}

/// The query with its primitives at rest, at the positions that they have at `time`. Positions are rounded
/// unless `time` is 0 or 1.
inline Query at_rest(Query query, double time) {
  for (std::size_t i = 0; i < 12; ++i) {
    const double place = (1 - time) * query.x[i] + time * query.x[12 + i];
    query.x[i] = query.x[12 + i] = place;
  }
  return query;
}

inline Query reversed(Query query) {
  std::rotate(query.x.begin(), query.x.begin() + 12, query.x.end());
  return query;
}

/// The earliest time at which the distance is at most the separation. This time must be a double.
inline double first_time(const Query& query) {
  const auto [lo, hi] = earliest_time(query)->enclosure();
  EXPECT_EQ(lo, hi);
  return lo;
}

}  // namespace nearmiss::testing
