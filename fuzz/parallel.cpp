#include "fuzz/parallel.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace nearmiss {

void in_parallel(int jobs, std::size_t count, const std::function<void(std::size_t)>& work) {
  // By default, the library starts at most one thread per core.
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(jobs));
  tbb::task_arena(jobs).execute([&] { tbb::parallel_for(std::size_t{0}, count, work); });
}

}  // namespace nearmiss
