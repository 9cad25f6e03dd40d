// The one way to use several cores.
#pragma once

#include <cstddef>
#include <functional>

namespace nearmiss {

/// Calls work(0) to work(count - 1), on so many threads. An exception of one of them is passed on.
void in_parallel(int jobs, std::size_t count, const std::function<void(std::size_t)>& work);

}  // namespace nearmiss
