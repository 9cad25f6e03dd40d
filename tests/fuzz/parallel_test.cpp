// Pieces of work run in parallel, and their results are delivered in the order of the pieces.
#include "fuzz/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

namespace nearmiss {
namespace {

struct Item {
  int number;
  int square = 0;
};

std::function<std::optional<Item>()> count_to(int end) {
  return [next = 0, end]() mutable { return next < end ? std::optional(Item{next++}) : std::nullopt; };
}

TEST(InOrder, TakesEveryItemAfterItsWork) {
  for (const int jobs : {1, 3}) {
    std::vector<int> taken;
    in_order<Item>(
        jobs, count_to(1000),
        [](Item& item) {
          if (item.number % 7 == 0) std::this_thread::yield();
          item.square = item.number * item.number;
        },
        [&](Item& item) {
          EXPECT_EQ(item.square, item.number * item.number);
          taken.push_back(item.number);
        });
    std::vector<int> all(1000);
    std::iota(all.begin(), all.end(), 0);
    EXPECT_EQ(taken, all);
  }
}

TEST(InOrder, LetsOnlyAFewItemsWaitForASlowOne) {
  std::atomic<int> taken{0};
  in_order<Item>(
      2, count_to(1000), [&](Item& item) { EXPECT_LE(item.number, taken + 32); }, [&](Item&) { ++taken; });
  EXPECT_EQ(taken, 1000);
}

TEST(InOrder, PassesOnAnException) {
  EXPECT_THROW(in_order<Item>(
                   2, count_to(100),
                   [](Item& item) {
                     if (item.number == 50) throw std::runtime_error("fifty");
                   },
                   [](Item& item) { EXPECT_LT(item.number, 50); }),
               std::runtime_error);
}

TEST(InOrder, FreesTheItemsBehindAnException) {
  const auto counted = std::make_shared<int>(0);
  std::atomic<int> worked{0};
  EXPECT_THROW(in_order<std::shared_ptr<int>>(
                   4, [&] { return std::optional(counted); },
                   [&](std::shared_ptr<int>& /*item*/) {
                     std::this_thread::sleep_for(std::chrono::milliseconds(1));
                     if (++worked >= 20) throw std::runtime_error("twenty");
                   },
                   [](std::shared_ptr<int>& /*item*/) {}),
               std::runtime_error);
  EXPECT_EQ(counted.use_count(), 1);
}

}  // namespace
}  // namespace nearmiss
