#include "oracle/filter/batch_filter.hpp"

namespace nearmiss::certified {

[[gnu::flatten]] void filter_with_sse2(const QueryRows& queries, double caution, FilterStage* stages,
                                       const QueryRows& ahead) {
  filter_batch<2>(queries, caution, stages, ahead);
}

}  // namespace nearmiss::certified
