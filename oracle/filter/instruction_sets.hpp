// The certified filter for many queries at once, compiled once for each instruction set.
#pragma once

#include <cstddef>

#include "ccd/query/query_rows.hpp"
#include "oracle/filter/filter.hpp"

namespace nearmiss::certified {

/// Number of queries per batch. The intermediate results of a batch fit into the nearest cache.
inline constexpr std::size_t batch_size = 128;

/// Decides at most batch_size queries, or leaves some of them `undecided`. Multiplies every error bound by
/// `caution`. If `times` is not null, also sets times[i] for each collision i whose first contact certainly
/// lies between two neighbouring doubles, and leaves the other times as they are. Meanwhile, the queries in
/// `ahead` are prefetched; `ahead` must have the size of `queries`.
using FilterBatch = void(const QueryRows& queries, double caution, FilterStage* stages, KnownTime* times,
                         const QueryRows& ahead);

FilterBatch filter_with_sse2;
FilterBatch filter_with_avx2;    ///< requires has(Instructions::avx2)
FilterBatch filter_with_avx512;  ///< requires has(Instructions::avx512)

}  // namespace nearmiss::certified
