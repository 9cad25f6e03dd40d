// A libFuzzer target: each input is the seed of a short trial.
#include <cstdint>
#include <cstring>
#include <iostream>
#include <nearmiss/trial.hpp>

#include "my_ccd.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::uint64_t seed = 0;
  std::memcpy(&seed, data, std::min(size, sizeof seed));
  const auto mine = nearmiss::plugin::detector("mine").vertex_triangle(user::point_triangle_ccd);
  const auto report = nearmiss::trial(mine, {.seed = seed, .cases = 100});
  if (report.clean()) return 0;
  std::cerr << report;
  __builtin_trap();
}
