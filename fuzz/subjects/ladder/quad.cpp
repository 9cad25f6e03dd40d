// IEEE's binary128, which g++ computes in software. clang has no library for it, and then there is no such scalar. The
// operations round to nearest, as those of machine_scalars.cpp. libquadmath's root does not always, but is within ε
// in a test against rational numbers.
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
