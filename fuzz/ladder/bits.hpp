// Scalars of any number of bits. Included by the files that list some of them.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "fuzz/ladder/scaled_subject.hpp"

namespace nearmiss::ladder {

/// Rounds to nearest in every operation, the root too; its exponents have no bounds that matter here.
template <unsigned bits>
using Bits = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<bits, boost::multiprecision::digit_base_2>,
    boost::multiprecision::et_off>;

template <unsigned bits>
inline constexpr Scalar bits_scalar(std::string_view name) {
  return {name, epsilon_exponent<Bits<bits>>, &make_scaled<Bits<bits>>};
}

}  // namespace nearmiss::ladder
