// Numbers of 384 bits, for distances that double words cannot resolve.
#pragma once

#include <boost/multiprecision/mpfr.hpp>
#include <limits>

#include "oracle/arithmetic/bernstein.hpp"

namespace nearmiss::certified {

/// Numbers of MPFR, kept on the stack. MPFR rounds to nearest. The exponents of MPFR have a far larger range
/// than those of double, so nothing here overflows or underflows.
using Wide = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<115, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;
static_assert(std::numeric_limits<Wide>::digits == 384);  // 115 decimal digits

template <>
inline constexpr double roundoff<Wide> = 0x1p-384;

}  // namespace nearmiss::certified
