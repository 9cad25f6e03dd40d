#include "ccd/wang/wang_lanes.hpp"

namespace nearmiss {

[[gnu::flatten]] void wang_with_sse2(const QueryRows& queries, Verdict* verdicts,
                                     const std::optional<double>& given) {
  decide_batch<2>(queries, verdicts, given);
}

}  // namespace nearmiss
