// The certified filter for many queries at once, compiled once for each instruction set.
#pragma once

#include <cstddef>

#include "ccd/query.hpp"
#include "oracle/filter/filter.hpp"

namespace nearmiss::certified {

/// So many queries are looked at together: what is kept of them stays in the nearest cache.
inline constexpr std::size_t batch_size = 128;

/// Decides queries, at most batch_size, with all bounds of rounding errors so many times as large as they
/// are, or leaves them `undecided`; the same stages by all. Meanwhile `count` queries at `ahead` are fetched
/// from memory.
using FilterBatch = void(const Query* queries, std::size_t count, double caution, FilterStage* stages,
                         const Query* ahead);

FilterBatch filter_with_sse2;
FilterBatch filter_with_avx2;    ///< only where has(Instructions::avx2)
FilterBatch filter_with_avx512;  ///< only where has(Instructions::avx512)

}  // namespace nearmiss::certified
