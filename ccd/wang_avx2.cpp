#include "ccd/wang_lanes.hpp"

namespace nearmiss {

[[gnu::flatten]] void wang_with_avx2(const Query* queries, std::size_t count, Verdict* verdicts) {
  decide_batch<4>(queries, count, verdicts);
}

}  // namespace nearmiss
