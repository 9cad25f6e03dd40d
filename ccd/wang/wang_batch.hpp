// `wang` for many queries at once, compiled once for each instruction set.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "ccd/query/instructions.hpp"
#include "ccd/query/query_rows.hpp"
#include "ccd/wang/verdict.hpp"

namespace nearmiss {

/// The verdict on a query that wang_in_lanes leaves undecided; `wang` must decide this query.
inline constexpr Verdict undecided_verdict{};
constexpr bool is_decided(const Verdict& verdict) {
  return verdict.hit || verdict.rejection != Rejection::untold;
}

/// Decides queries as `wang` does (wang.hpp), with the bound `given` if it is set, else with each pair's own
/// bound. Leaves these queries undecided: queries that need vertex-edge tests, another frame or another order
/// of end points; queries of the kinds vv and ve; queries whose own bound exceeds the given bound; and
/// queries with a coordinate that is not finite.
void wang_in_lanes(const QueryRows& queries, std::span<Verdict> verdicts,
                   const std::optional<double>& given = std::nullopt,
                   Instructions instructions = chosen_instructions());

/// The largest number of queries in a batch. With this number, the intermediate results of a batch fit into
/// the caches of a processor core.
inline constexpr std::size_t wang_batch_size = 128;

/// The type of a function that decides a batch as wang_in_lanes does, with one instruction set.
using WangBatch = void(const QueryRows& queries, Verdict* verdicts, const std::optional<double>& given);

WangBatch wang_with_sse2;
WangBatch wang_with_avx2;    ///< requires has(Instructions::avx2)
WangBatch wang_with_avx512;  ///< requires has(Instructions::avx512)

}  // namespace nearmiss
