// A campaign allocates memory for its slices, but not for each query.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <limits>
#include <new>

#include "fuzz/trial/campaign.hpp"

namespace {
std::atomic<std::uint64_t> allocations = 0;
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* const memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*size*/) noexcept { std::free(memory); }

namespace nearmiss {
namespace {

/// The number of allocations in a campaign of the uniform family on one thread, which compares no methods of the oracle.
std::uint64_t allocations_of(const char* subject, std::uint64_t cases) {
  CampaignPlan plan;
  plan.families = {find_family("uniform")};
  plan.cases = cases;
  plan.jobs = 1;
  plan.comparison.one_in = std::numeric_limits<std::uint64_t>::max();
  Subjects subjects;
  subjects.push_back(make_subject(subject));
  const std::uint64_t before = allocations;
  run_campaign(
      plan, subjects, [](TrialResult&& /*result*/, const CampaignProgress& /*now*/) { return true; },
      Stop::never());
  return allocations - before;
}

class Allocations : public ::testing::TestWithParam<const char*> {};
TEST_P(Allocations, AreFewerThanOneInTenCases) {
  constexpr std::uint64_t cases = 100'000;
  const std::uint64_t first = allocations_of(GetParam(), cases);
  const std::uint64_t both = allocations_of(GetParam(), 2 * cases);
  std::cout << "allocations per 1,000 cases: " << (both - first) * 1000 / cases << "\n";
  EXPECT_LT(both - first, cases / 10);
}
INSTANTIATE_TEST_SUITE_P(Of, Allocations, ::testing::Values("wang", "wang-scalar", "basic"));

}  // namespace
}  // namespace nearmiss
