// The certified filter for many queries, with the widest instructions that this machine has.
#include "oracle/batch.hpp"

#include <algorithm>

#include "ccd/arithmetic.hpp"
#include "oracle/filter.hpp"

namespace nearmiss {

namespace certified {
namespace {

FilterBatch* filter_with(Instructions instructions) {
  switch (instructions) {
    case Instructions::avx512:
      return filter_with_avx512;
    case Instructions::avx2:
      return filter_with_avx2;
    default:
      return filter_with_sse2;
  }
}

void filter_all(std::span<const Query> queries, double caution, std::span<FilterStage> stages,
                Instructions instructions) {
  const PlainArithmetic guard;
  FilterBatch* const filter_batch = filter_with(instructions);
  for (std::size_t first = 0; first < queries.size(); first += batch_size) {
    const std::size_t count = std::min(batch_size, queries.size() - first);
    const std::size_t ahead = std::min(first + batch_size, queries.size() - count);
    filter_batch(&queries[first], count, caution, &stages[first], &queries[ahead]);
  }
}

}  // namespace
}  // namespace certified

bool has(Instructions instructions) {
  switch (instructions) {
    case Instructions::avx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512vl");
    case Instructions::avx2:
      return __builtin_cpu_supports("avx2");
    default:
      return true;
  }
}

Instructions widest_instructions() {
  static const Instructions widest = has(Instructions::avx512) ? Instructions::avx512
                                     : has(Instructions::avx2) ? Instructions::avx2
                                                               : Instructions::sse2;
  return widest;
}

void filter(std::span<const Query> queries, std::span<FilterStage> stages, Instructions instructions) {
  certified::filter_all(queries, 1, stages, instructions);
  for (std::size_t i = 0; i < queries.size(); ++i)
    if (stages[i] == FilterStage::undecided) stages[i] = filter(queries[i]);
}

void filter_with_caution(std::span<const Query> queries, double caution, std::span<FilterStage> stages) {
  certified::filter_all(queries, caution, stages, widest_instructions());
}

}  // namespace nearmiss
