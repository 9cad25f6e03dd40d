#include "ccd/wang/wang_batch.hpp"

#include <algorithm>
#include <array>

namespace nearmiss {

void wang_in_lanes(const QueryRows& queries, std::span<Verdict> verdicts, const std::optional<double>& given,
                   Instructions instructions) {
  constexpr std::array<WangBatch*, all_instructions.size()> all{wang_with_sse2, wang_with_avx2,
                                                                wang_with_avx512};
  WangBatch* const decide = all[static_cast<std::size_t>(instructions)];
  for (std::size_t first = 0; first < queries.size(); first += wang_batch_size)
    decide(queries.part(first, std::min(wang_batch_size, queries.size() - first)), &verdicts[first], given);
}

}  // namespace nearmiss
