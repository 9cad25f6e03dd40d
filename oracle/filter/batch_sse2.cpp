#include "oracle/filter/batch_filter.hpp"

namespace nearmiss::certified {

[[gnu::flatten]] void filter_with_sse2(const QueryRows& queries, double caution, FilterStage* stages,
                                       KnownTime* times, const QueryRows& ahead) {
  filter_batch<2>(queries, caution, stages, times, ahead);
}

}  // namespace nearmiss::certified
