// Numbers of any number of bits as a scalar of ccd/'s templates.
#pragma once

#include <mpfr.h>

#include <Eigen/Core>
#include <array>
#include <limits>

namespace nearmiss {

/// A number with as many bits as the thread's precision says: MPFR's, but without memory of its own. Every
/// operation, the root too, rounds to nearest, so that its relative error is within u = 2^-bits = ε/2; exponents
/// have no bounds that matter here.
class Bits {
 public:
  static constexpr int most = 256;

  /// How many bits this thread's numbers have, for a scope; not outside any. Numbers do not outlive it.
  class Precision {
   public:
    explicit Precision(int bits) : before_(precision_) { precision_ = bits; }
    ~Precision() { precision_ = before_; }
    Precision(const Precision&) = delete;
    Precision& operator=(const Precision&) = delete;

   private:
    mpfr_prec_t before_;
  };
  static int precision() { return static_cast<int>(precision_); }

  Bits() { mpfr_custom_init_set(value_, MPFR_ZERO_KIND, 0, precision_, limbs_.data()); }
  Bits(double value) : Bits() { mpfr_set_d(value_, value, MPFR_RNDN); }
  Bits(const Bits& other) { *this = other; }
  Bits& operator=(const Bits& other) {
    limbs_ = other.limbs_;
    value_[0] = other.value_[0];
    mpfr_custom_move(value_, limbs_.data());
    return *this;
  }

  /// The nearest double.
  explicit operator double() const { return mpfr_get_d(value_, MPFR_RNDN); }
  [[nodiscard]] mpfr_srcptr value() const { return value_; }

  friend Bits operator-(const Bits& a) { return of(mpfr_neg, a); }
  friend Bits operator+(const Bits& a, const Bits& b) { return of(mpfr_add, a, b); }
  friend Bits operator-(const Bits& a, const Bits& b) { return of(mpfr_sub, a, b); }
  friend Bits operator*(const Bits& a, const Bits& b) { return of(mpfr_mul, a, b); }
  friend Bits operator/(const Bits& a, const Bits& b) { return of(mpfr_div, a, b); }
  Bits& operator+=(const Bits& b) { return *this = *this + b; }
  Bits& operator-=(const Bits& b) { return *this = *this - b; }
  Bits& operator*=(const Bits& b) { return *this = *this * b; }
  Bits& operator/=(const Bits& b) { return *this = *this / b; }

  friend bool operator==(const Bits& a, const Bits& b) { return mpfr_equal_p(a.value_, b.value_) != 0; }
  friend bool operator!=(const Bits& a, const Bits& b) { return !(a == b); }
  friend bool operator<(const Bits& a, const Bits& b) { return mpfr_less_p(a.value_, b.value_) != 0; }
  friend bool operator<=(const Bits& a, const Bits& b) { return mpfr_lessequal_p(a.value_, b.value_) != 0; }
  friend bool operator>(const Bits& a, const Bits& b) { return b < a; }
  friend bool operator>=(const Bits& a, const Bits& b) { return b <= a; }

  friend Bits abs(const Bits& a) { return mpfr_signbit(a.value_) != 0 ? -a : a; }
  friend Bits sqrt(const Bits& a) { return of(mpfr_sqrt, a); }
  friend Bits ldexp(const Bits& a, int exponent) {
    Bits result;
    mpfr_mul_2si(result.value_, a.value_, exponent, MPFR_RNDN);
    return result;
  }
  /// Of a number that is neither 0 nor infinite.
  friend int ilogb(const Bits& a) { return static_cast<int>(mpfr_get_exp(a.value_)) - 1; }
  friend bool isfinite(const Bits& a) { return mpfr_number_p(a.value_) != 0; }

 private:
  static Bits of(int (*operation)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t), const Bits& a) {
    Bits result;
    operation(result.value_, a.value_, MPFR_RNDN);
    return result;
  }
  static Bits of(int (*operation)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t), const Bits& a,
                 const Bits& b) {
    Bits result;
    operation(result.value_, a.value_, b.value_, MPFR_RNDN);
    return result;
  }

  static inline thread_local mpfr_prec_t precision_ = 0;

  mpfr_t value_;
  std::array<mp_limb_t, most / 64> limbs_;
};

}  // namespace nearmiss

/// What does not depend on the precision, as of double: it has double's range at least.
template <>
struct std::numeric_limits<nearmiss::Bits> : std::numeric_limits<double> {
  static nearmiss::Bits epsilon() { return ldexp(nearmiss::Bits(1), 1 - nearmiss::Bits::precision()); }
  static nearmiss::Bits min() { return std::numeric_limits<double>::min(); }
  static nearmiss::Bits max() { return std::numeric_limits<double>::max(); }
  static nearmiss::Bits infinity() { return std::numeric_limits<double>::infinity(); }
};

template <>
struct Eigen::NumTraits<nearmiss::Bits> : Eigen::GenericNumTraits<nearmiss::Bits> {
  enum {
    IsInteger = 0,
    IsSigned = 1,
    IsComplex = 0,
    RequireInitialization = 1,
    ReadCost = 4,
    AddCost = 10,
    MulCost = 10
  };
};
