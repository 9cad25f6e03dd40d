// Writes queries of the kinds vt and ee from all families, with the answers of this source tree, to standard
// output. The format is the one that answers.cpp reads.
// Usage: answered_queries COUNT SEED
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <span>
#include <vector>

#include "ccd/query/queries.h"
#include "fuzz/families/families.hpp"
#include "fuzz/subjects/built_in.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {
namespace {

template <class T>
void write(const std::vector<T>& numbers) {
  if (std::fwrite(numbers.data(), sizeof(T), numbers.size(), stdout) != numbers.size()) std::exit(2);
}

template <class T, class Of>
void write_each(std::span<const Query> queries, const Of& of) {
  std::vector<T> numbers;
  for (const Query& query : queries) numbers.push_back(of(query));
  write(numbers);
}

void write_block(std::span<const Query> queries, bool is_timed) {
  static const auto exact = make_built_in("exact-decision");
  static const auto wang = make_built_in("wang");
  write(std::vector<std::int32_t>{
      queries[0].kind == Kind::edge_edge ? NEARMISS_EDGE_EDGE : NEARMISS_VERTEX_TRIANGLE,
      static_cast<std::int32_t>(queries.size()), is_timed ? 1 : 0});
  std::vector<double> x;
  for (const Query& query : queries) x.insert(x.end(), query.x.begin(), query.x.end());
  write(x);
  write_each<double>(queries, [](const Query& query) { return query.separation; });
  write_each<std::int8_t>(queries, [](const Query& query) { return exact->decide(query).hit; });
  write_each<std::int8_t>(queries,
                          [](const Query& query) { return wang->decide(with_separation(query, 0)).hit; });
  write_each<double>(queries, [](const Query& query) { return wang->distance_bound(query); });
  if (!is_timed) return;
  std::vector<double> times[2], distances[2];
  for (const Query& query : queries) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    auto time = earliest_time(query);
    const Enclosure enclosure = time ? time->enclosure() : Enclosure{infinity, infinity};
    times[0].push_back(enclosure.lo);
    times[1].push_back(enclosure.hi);
    const Enclosure distance = minimum_distance(query);
    distances[0].push_back(distance.lo);
    distances[1].push_back(distance.hi);
  }
  for (const auto* each : {&times[0], &times[1], &distances[0], &distances[1]}) write(*each);
}

}  // namespace
}  // namespace nearmiss

int main(int count_of_arguments, char** arguments) {
  using namespace nearmiss;
  if (count_of_arguments != 3) return 2;
  const std::size_t count = std::strtoull(arguments[1], nullptr, 10);
  const std::uint64_t seed = std::strtoull(arguments[2], nullptr, 10);
  constexpr std::size_t most = 200;  // the largest number of queries in a block
  std::vector<Query> of_kind[2];
  std::size_t blocks = 0;
  const auto write_kind = [&](std::vector<Query>& queries) {
    if (!queries.empty()) write_block(queries, blocks++ % 128 < 2);
    queries.clear();
  };
  const auto& families = mesh_families();
  for (std::size_t i = 0; i < count; ++i) {
    const Query query = make_query(families[i % families.size()], seed, i / families.size());
    std::vector<Query>& queries = of_kind[query.kind == Kind::edge_edge ? 1 : 0];
    queries.push_back(query);
    if (queries.size() == most) write_kind(queries);
  }
  for (auto& queries : of_kind) write_kind(queries);
  return 0;
}
