// Functions that several benchmarks use.
#pragma once

#include <benchmark/benchmark.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "fuzz/families/families.hpp"

namespace nearmiss {

/// Queries of one kind from the uniform family. If `count` is ten thousand or more, a branch predictor cannot
/// memorise the queries, just as it cannot memorise the queries of a campaign.
inline std::vector<Query> uniform_queries(Kind kind, std::size_t count) {
  const Family uniform = find_family("uniform");
  std::vector<Query> queries;
  for (std::uint64_t i = 0; queries.size() < count; ++i)
    if (kind_of(uniform, i) == kind) queries.push_back(make_query(uniform, 1, i));
  return queries;
}

/// Registers a benchmark whose function measures the time of each pass itself.
inline void add_measured(const std::string& name, const std::function<void(benchmark::State&)>& measure) {
  constexpr int passes = 2;
  constexpr int repetitions = 15;
  benchmark::RegisterBenchmark(name.c_str(), measure)
      ->UseManualTime()
      ->Iterations(passes)
      ->Repetitions(repetitions)
      ->ReportAggregatesOnly();
}

}  // namespace nearmiss
