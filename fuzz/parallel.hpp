// Parallel loops; the only use of threads.
#pragma once

#include <cstddef>
#include <functional>

namespace nearmiss {

/// Calls work(0) to work(count - 1) on `jobs` threads. Passes an exception on to the caller.
void in_parallel(int jobs, std::size_t count, const std::function<void(std::size_t)>& work);

}  // namespace nearmiss
