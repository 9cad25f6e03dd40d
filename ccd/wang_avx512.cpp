#include "ccd/wang_lanes.hpp"

namespace nearmiss {

[[gnu::flatten]] void wang_with_avx512(const Query* queries, std::size_t count, Verdict* verdicts) {
  decide_batch<8>(queries, count, verdicts);
}

}  // namespace nearmiss
