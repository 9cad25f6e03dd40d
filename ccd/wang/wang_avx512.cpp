#include "ccd/wang/wang_lanes.hpp"

namespace nearmiss {

[[gnu::flatten]] void wang_with_avx512(const QueryRows& queries, Verdict* verdicts) {
  decide_batch<8>(queries, verdicts);
}

}  // namespace nearmiss
