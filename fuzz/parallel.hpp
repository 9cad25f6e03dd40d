// Parallel loops. If the work throws an exception, the loop passes it on to its caller. Shrinking
// (trial/shrinking.hpp) does not use these loops: it runs at the same time, on threads of its own.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

namespace nearmiss {

/// Starts a thread. If the system has no thread left, returns a thread that is not joinable.
std::thread start_thread(std::function<void()> work);

/// Calls work(0) to work(count - 1) on `jobs` threads, or on as many as the system can start.
void in_parallel(int jobs, std::size_t count, const std::function<void(std::size_t)>& work);

/// Calls work(first, last) for consecutive parts [first, last) of [0, count), on all processors. If `count`
/// is small, calls work(0, count) once, on the calling thread.
template <class PartWork>
void in_parts(std::size_t count, const PartWork& work) {
  constexpr std::size_t part = 16384;
  if (count <= 4 * part) {
    work(std::size_t{0}, count);
    return;
  }
  in_parallel(static_cast<int>(std::max(1U, std::thread::hardware_concurrency())), (count + part - 1) / part,
              [&](std::size_t i) { work(part * i, std::min(count, part * (i + 1))); });
}

namespace detail {
using Untyped = std::shared_ptr<void>;
void in_order(int jobs, const std::function<Untyped()>& next, const std::function<void(void*)>& work,
              const std::function<void(void*)>& take);
}  // namespace detail

/// Runs a pipeline. next() makes items until it returns nothing. work(item) runs on `jobs` threads, or on as
/// many as the system can start. take(item) receives each item after its work. take() receives the items in
/// the order in which next() makes them. Only one call of next() runs at a time, and only one call of take().
/// At most 16 items per thread exist at the same time.
template <class Item>
void in_order(int jobs, const std::function<std::optional<Item>()>& next,
              const std::function<void(Item&)>& work, const std::function<void(Item&)>& take) {
  detail::in_order(
      jobs,
      [&]() -> detail::Untyped {
        auto item = next();
        return item ? std::make_shared<Item>(*std::move(item)) : nullptr;
      },
      [&](void* item) { work(*static_cast<Item*>(item)); },
      [&](void* item) { take(*static_cast<Item*>(item)); });
}

}  // namespace nearmiss
