#include "oracle/batch_filter.hpp"

namespace nearmiss::certified {

[[gnu::flatten]] void filter_with_sse2(const Query* queries, std::size_t count, FilterStage* stages,
                                       const Query* ahead) {
  filter_batch<2>(queries, count, stages, ahead);
}

}  // namespace nearmiss::certified
