#include "ccd/instructions.hpp"

#include <algorithm>
#include <cstdlib>
#include <string>

#include "ccd/error.hpp"
#include "ccd/excerpt.hpp"

namespace nearmiss {

namespace {

Instructions choose(const char* given) {
  if (given == nullptr || *given == '\0') return widest_instructions();
  const auto* const wanted =
      std::find_if(all_instructions.begin(), all_instructions.end(),
                   [given](Instructions each) { return std::to_string(lanes(each)) == given; });
  if (wanted == all_instructions.end())
    throw Error("NEARMISS_LANES: found '" + excerpt(given) + "', expected 2, 4 or 8");
  if (!has(*wanted))
    throw Error("NEARMISS_LANES: found " + std::string(given) + ", expected at most " +
                std::to_string(lanes(widest_instructions())) + " on this machine");
  return *wanted;
}

}  // namespace

bool has(Instructions instructions) {
  switch (instructions) {
    case Instructions::avx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("bmi2");
    case Instructions::avx2:
      return __builtin_cpu_supports("avx2");
    default:
      return true;
  }
}

Instructions widest_instructions() {
  return *std::find_if(all_instructions.rbegin(), all_instructions.rend(), has);
}

Instructions chosen_instructions() {
  static const Instructions chosen = choose(std::getenv("NEARMISS_LANES"));
  return chosen;
}

}  // namespace nearmiss
