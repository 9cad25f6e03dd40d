// nearmiss needs a compiler that follows IEEE 754, and plain arithmetic: arithmetic that rounds to nearest,
// keeps subnormals and does not trap. This header checks the compiler, and checks and sets the processor's
// mode.
#pragma once

#include <cfenv>
#include <cfloat>
#include <limits>
#include <string>

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

// Only the plug-ins of fuzz/studies/environments, which measure other arithmetic, define
// NEARMISS_ANY_ARITHMETIC. No macro shows whether a compiler contracts a product and a sum to an FMA
// (ccd/README.md).
#ifndef NEARMISS_ANY_ARITHMETIC
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "nearmiss needs IEEE arithmetic: found -ffast-math or a part of it"
#endif
static_assert(FLT_EVAL_METHOD == 0, "nearmiss needs every operation to be rounded to its own type");
static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<double>::digits == 53 &&
                  std::numeric_limits<float>::is_iec559 && std::numeric_limits<float>::digits == 24,
              "nearmiss needs IEEE double and float");
#endif

namespace nearmiss {

/// Whether this thread's arithmetic is plain, as defined above. Takes about a nanosecond.
inline bool is_arithmetic_plain() {
#ifdef __SSE2__
  constexpr unsigned flags = 0x3f;    // exceptions raised so far
  constexpr unsigned plain = 0x1f80;  // all traps masked, rounding to nearest, no flushing
  return (_mm_getcsr() & 0xffffU & ~flags) == plain;
#else
  return std::fegetround() == FE_TONEAREST;
#endif
}

/// How this thread's arithmetic differs from plain arithmetic, such as "rounds upward, flushes subnormals to
/// zero", or "" if it does not differ.
std::string odd_arithmetic();

inline void make_arithmetic_plain() {
  if (!is_arithmetic_plain()) [[unlikely]]
    std::fesetenv(FE_DFL_ENV);
}

/// Makes this thread's arithmetic plain while the object exists, then restores the caller's mode. Every entry
/// point whose results are proven only for plain arithmetic creates such an object. A build with
/// NEARMISS_UNGUARDED keeps the caller's mode.
class PlainArithmetic {
 public:
  PlainArithmetic() {
#ifndef NEARMISS_UNGUARDED
    if (is_arithmetic_plain()) [[likely]]
      return;
    std::fegetenv(&callers_);
    std::fesetenv(FE_DFL_ENV);
    changed_ = true;
#endif
  }
  ~PlainArithmetic() {
    if (changed_) [[unlikely]]
      std::fesetenv(&callers_);
  }
  PlainArithmetic(const PlainArithmetic&) = delete;
  PlainArithmetic& operator=(const PlainArithmetic&) = delete;

 private:
  std::fenv_t callers_;
  bool changed_ = false;
};

}  // namespace nearmiss
