#include "oracle/batch_filter.hpp"

namespace nearmiss::certified {

[[gnu::flatten]] void filter_with_avx512(const Query* queries, std::size_t count, FilterStage* stages,
                                         const Query* ahead) {
  filter_batch<8>(queries, count, stages, ahead);
}

}  // namespace nearmiss::certified
