// The binary128 type of IEEE 754, which g++ computes in software. clang has no library for it, so clang
// builds lack this scalar. The operations round to nearest, like those of machine_scalars.cpp. The square
// root of libquadmath does not always round to nearest, but is within ε in a test with rational numbers.
#include "fuzz/subjects/ladder/scalars.hpp"

#if __has_include(<quadmath.h>)
#include <boost/multiprecision/float128.hpp>

#include "fuzz/subjects/ladder/scaled_subject.hpp"

namespace nearmiss::ladder {

std::vector<Scalar> quad_scalar() {
  using Quad = boost::multiprecision::float128;
  return {{"quad", epsilon_exponent<Quad>, &make_scaled<Quad>}};
}

}  // namespace nearmiss::ladder

#else

namespace nearmiss::ladder {

std::vector<Scalar> quad_scalar() { return {}; }

}  // namespace nearmiss::ladder

#endif
