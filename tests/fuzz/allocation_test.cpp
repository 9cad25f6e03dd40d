// A campaign allocates memory for its slices, but not for each query.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <limits>
#include <new>

#include "fuzz/trial/campaign.hpp"
#include "tests/fuzz/trials.hpp"

namespace {
std::atomic<std::uint64_t> allocations = 0;
}

// Not inlined, because g++ 12 would otherwise warn that new and free do not match.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  while (true) {
    if (void* const memory = std::malloc(size)) return memory;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/) noexcept { std::free(memory); }

namespace nearmiss {
namespace {

/// The number of allocations of a campaign of `uniform`, on one thread and without comparing methods.
std::uint64_t allocations_of(const char* subject, std::uint64_t cases) {
  CampaignPlan plan;
  plan.families = {find_family("uniform")};
  plan.cases = cases;
  plan.jobs = 1;
  plan.comparison.one_in = std::numeric_limits<std::uint64_t>::max();
  const Subjects subjects = testing::subjects_named({subject});
  const std::uint64_t before = allocations;
  run_campaign(
      plan, subjects, [](TrialResult&& /*result*/, const CampaignProgress& /*now*/) { return true; },
      Stop::never());
  return allocations - before;
}

/// A campaign asks in slices of 1,024 cases, which contain both kinds. A slice needs about 60 allocations for
/// each kind.
class Allocations : public ::testing::TestWithParam<const char*> {};
TEST_P(Allocations, AreThoseOfSlices) {
  constexpr std::uint64_t slices = 100;
  constexpr std::uint64_t cases = slices * 1024;
  const std::uint64_t first = allocations_of(GetParam(), cases);
  const std::uint64_t both = allocations_of(GetParam(), 2 * cases);
  EXPECT_LT(both - first, slices * 160);
}
INSTANTIATE_TEST_SUITE_P(Of, Allocations, ::testing::Values("wang", "wang-scalar"));

}  // namespace
}  // namespace nearmiss
