// Parallel loops, the only place that uses threads.
#pragma once

#include <cstddef>
#include <functional>

namespace nearmiss {

/// Calls work(0) to work(count - 1) on `jobs` threads. An exception is passed on to the caller.
void in_parallel(int jobs, std::size_t count, const std::function<void(std::size_t)>& work);

}  // namespace nearmiss
