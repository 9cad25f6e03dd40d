// MPFR numbers with a number of bits that is set at run time, as a scalar for the templates of ccd/.
#pragma once

#include <mpfr.h>

#include <array>
#include <limits>

#include "fuzz/subjects/ladder/scalar_traits.hpp"

namespace nearmiss {

/// A number of at most `most` bits, without heap memory. The thread's PrecisionScope sets the number of bits.
/// Every operation, including the square root, rounds to nearest, so its relative error is at most u =
/// 2^-bits = ε/2. The algorithms of ccd/ never reach the limits of MPFR's exponents.
class MpfrFloat {
 public:
  static constexpr int most = 256;

  /// While a PrecisionScope exists, this thread's numbers have `bits` bits. Numbers may exist only while a
  /// PrecisionScope exists.
  class PrecisionScope {
   public:
    explicit PrecisionScope(int bits) : before_(precision_) { precision_ = bits; }
    ~PrecisionScope() { precision_ = before_; }
    PrecisionScope(const PrecisionScope&) = delete;
    PrecisionScope& operator=(const PrecisionScope&) = delete;

   private:
    mpfr_prec_t before_;
  };
  static int precision() { return static_cast<int>(precision_); }

  MpfrFloat() { mpfr_custom_init_set(value_, MPFR_ZERO_KIND, 0, precision_, limbs_.data()); }
  MpfrFloat(double value) : MpfrFloat() { mpfr_set_d(value_, value, MPFR_RNDN); }
  MpfrFloat(const MpfrFloat& other) { *this = other; }
  MpfrFloat& operator=(const MpfrFloat& other) {
    limbs_ = other.limbs_;
    value_[0] = other.value_[0];
    mpfr_custom_move(value_, limbs_.data());
    return *this;
  }

  /// The nearest double.
  explicit operator double() const { return mpfr_get_d(value_, MPFR_RNDN); }
  [[nodiscard]] mpfr_srcptr value() const { return value_; }

  friend MpfrFloat operator-(const MpfrFloat& a) { return of(mpfr_neg, a); }
  friend MpfrFloat operator+(const MpfrFloat& a, const MpfrFloat& b) { return of(mpfr_add, a, b); }
  friend MpfrFloat operator-(const MpfrFloat& a, const MpfrFloat& b) { return of(mpfr_sub, a, b); }
  friend MpfrFloat operator*(const MpfrFloat& a, const MpfrFloat& b) { return of(mpfr_mul, a, b); }
  friend MpfrFloat operator/(const MpfrFloat& a, const MpfrFloat& b) { return of(mpfr_div, a, b); }
  MpfrFloat& operator+=(const MpfrFloat& b) { return *this = *this + b; }
  MpfrFloat& operator-=(const MpfrFloat& b) { return *this = *this - b; }
  MpfrFloat& operator*=(const MpfrFloat& b) { return *this = *this * b; }
  MpfrFloat& operator/=(const MpfrFloat& b) { return *this = *this / b; }

  friend bool operator==(const MpfrFloat& a, const MpfrFloat& b) {
    return mpfr_equal_p(a.value_, b.value_) != 0;
  }
  friend bool operator!=(const MpfrFloat& a, const MpfrFloat& b) { return !(a == b); }
  friend bool operator<(const MpfrFloat& a, const MpfrFloat& b) {
    return mpfr_less_p(a.value_, b.value_) != 0;
  }
  friend bool operator<=(const MpfrFloat& a, const MpfrFloat& b) {
    return mpfr_lessequal_p(a.value_, b.value_) != 0;
  }
  friend bool operator>(const MpfrFloat& a, const MpfrFloat& b) { return b < a; }
  friend bool operator>=(const MpfrFloat& a, const MpfrFloat& b) { return b <= a; }

  friend MpfrFloat abs(const MpfrFloat& a) { return mpfr_signbit(a.value_) != 0 ? -a : a; }
  friend MpfrFloat sqrt(const MpfrFloat& a) { return of(mpfr_sqrt, a); }
  friend MpfrFloat ldexp(const MpfrFloat& a, int exponent) {
    MpfrFloat result;
    mpfr_mul_2si(result.value_, a.value_, exponent, MPFR_RNDN);
    return result;
  }
  /// The binary exponent of a finite number other than 0.
  friend int ilogb(const MpfrFloat& a) { return static_cast<int>(mpfr_get_exp(a.value_)) - 1; }
  friend bool isfinite(const MpfrFloat& a) { return mpfr_number_p(a.value_) != 0; }

 private:
  static MpfrFloat of(int (*operation)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t), const MpfrFloat& a) {
    MpfrFloat result;
    operation(result.value_, a.value_, MPFR_RNDN);
    return result;
  }
  static MpfrFloat of(int (*operation)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t), const MpfrFloat& a,
                      const MpfrFloat& b) {
    MpfrFloat result;
    operation(result.value_, a.value_, b.value_, MPFR_RNDN);
    return result;
  }

  static inline thread_local mpfr_prec_t precision_ = 0;

  mpfr_t value_;
  std::array<mp_limb_t, most / 64> limbs_;
};

}  // namespace nearmiss

template <>
struct std::numeric_limits<nearmiss::MpfrFloat> : nearmiss::ladder::LimitsOfDouble<nearmiss::MpfrFloat> {
  static nearmiss::MpfrFloat epsilon() {
    return ldexp(nearmiss::MpfrFloat(1), 1 - nearmiss::MpfrFloat::precision());
  }
};

template <>
struct Eigen::NumTraits<nearmiss::MpfrFloat> : nearmiss::ladder::RealTraits<nearmiss::MpfrFloat, 4, 10, 10> {
};
