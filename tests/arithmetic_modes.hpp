// Modes of the processor's arithmetic that differ from the default.
#pragma once

#include <pmmintrin.h>

#include <array>
#include <cfenv>

namespace nearmiss::testing {

/// Sets a rounding mode for a scope; if `flushes`, the processor also takes subnormal numbers for zero. The
/// end of the scope restores the default mode.
class HostileArithmetic {
 public:
  explicit HostileArithmetic(int rounding, bool flushes = false) {
    std::fesetround(rounding);
    if (!flushes) return;
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
  }
  ~HostileArithmetic() { std::fesetenv(FE_DFL_ENV); }
  HostileArithmetic(const HostileArithmetic&) = delete;
  HostileArithmetic& operator=(const HostileArithmetic&) = delete;
};

inline constexpr std::array directed{FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};

}  // namespace nearmiss::testing
