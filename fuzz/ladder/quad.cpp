// IEEE's binary128, which g++ computes in software; clang has no library for it, and then there is none.
#include <array>

#include "fuzz/ladder/scalars.hpp"

#if __has_include(<quadmath.h>)
#include <boost/multiprecision/float128.hpp>

#include "fuzz/ladder/scaled_subject.hpp"

namespace nearmiss::ladder {

namespace {

using Quad = boost::multiprecision::float128;
constexpr std::array all{Scalar{"quad", epsilon_exponent<Quad>, &make_scaled<Quad>}};

}  // namespace

std::span<const Scalar> quad_scalar() { return all; }

}  // namespace nearmiss::ladder

#else

namespace nearmiss::ladder {

std::span<const Scalar> quad_scalar() { return {}; }

}  // namespace nearmiss::ladder

#endif
