#include "ccd/query/instructions.hpp"

#include <algorithm>
#include <string>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"

namespace nearmiss {

namespace {

Instructions& chosen() {
  static Instructions instructions = widest_instructions();
  return instructions;
}

}  // namespace

bool has(Instructions instructions) {
  switch (instructions) {
#ifdef __x86_64__
    case Instructions::avx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("bmi2");
    case Instructions::avx2:
      return __builtin_cpu_supports("avx2");
#endif
    default:
      return instructions == Instructions::sse2;
  }
}

Instructions widest_instructions() {
  return *std::find_if(all_instructions.rbegin(), all_instructions.rend(), has);
}

Instructions chosen_instructions() { return chosen(); }

void choose_instructions(std::string_view given) {
  const auto* const wanted =
      std::find_if(all_instructions.begin(), all_instructions.end(),
                   [given](Instructions each) { return std::to_string(lanes(each)) == given; });
  if (wanted == all_instructions.end()) throw Error("found '" + excerpt(given) + "', expected 2, 4 or 8");
  if (!has(*wanted))
    throw Error("found " + std::string(given) + ", expected at most " +
                std::to_string(lanes(widest_instructions())) + " on this machine");
  chosen() = *wanted;
}

}  // namespace nearmiss
