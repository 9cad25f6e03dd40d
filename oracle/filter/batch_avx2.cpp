#include "oracle/filter/batch_filter.hpp"

namespace nearmiss::certified {

[[gnu::flatten]] void filter_with_avx2(const Query* queries, std::size_t count, double caution,
                                       FilterStage* stages, const Query* ahead) {
  filter_batch<4>(queries, count, caution, stages, ahead);
}

}  // namespace nearmiss::certified
