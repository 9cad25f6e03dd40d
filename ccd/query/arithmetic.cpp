#include "ccd/query/arithmetic.hpp"

namespace nearmiss {

std::string odd_arithmetic() {
  // Computes with known numbers to find the mode, because the control registers differ between processors.
  const volatile double one = 1;
  const volatile double minus_one = -1;
  const volatile double tiny = std::numeric_limits<double>::min();
  const volatile double half = 0.5;
  const volatile double subnormal = std::numeric_limits<double>::denorm_min();
  const volatile double large = 0x1p100;
  std::string text;
  const auto add = [&](bool is_so, const char* what) {
    if (is_so) text += (text.empty() ? "" : ", ") + std::string(what);
  };
  const bool upward = one + tiny > one;
  const bool downward = minus_one - tiny < minus_one;
  add(upward, "rounds upward");
  add(downward, "rounds downward");
  add(!downward && one - tiny < one, "rounds toward zero");
  add(tiny * half == 0, "flushes subnormals to zero");
  add(subnormal * large == 0, "takes subnormals for zero");
  if (text.empty() && !is_arithmetic_plain()) text = "traps";
  return text;
}

}  // namespace nearmiss
