// Numbers of 384 bits, for distances that double words cannot resolve.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "oracle/arithmetic/bernstein.hpp"

namespace nearmiss::certified {

/// Rounds to nearest. The exponent range is far larger than that of double, so nothing here overflows or
/// underflows.
using Wide = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<384, boost::multiprecision::digit_base_2>,
    boost::multiprecision::et_off>;

template <>
inline constexpr double roundoff<Wide> = 0x1p-384;

}  // namespace nearmiss::certified
