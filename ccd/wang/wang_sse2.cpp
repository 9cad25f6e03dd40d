#include "ccd/wang/wang_lanes.hpp"

namespace nearmiss {

[[gnu::flatten]] void wang_with_sse2(const QueryRows& queries, Verdict* verdicts) {
  decide_batch<2>(queries, verdicts);
}

}  // namespace nearmiss
