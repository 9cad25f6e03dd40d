#include <fmt/format.h>

#include "fuzz/subjects/ladder/mpfr_float.hpp"
#include "fuzz/subjects/ladder/scaled_subject.hpp"

namespace nearmiss::ladder {

namespace {

/// While an object of this type exists, MPFR numbers of this thread have 1 - epsilon_exponent bits. The
/// member `guard` makes the processor's arithmetic plain (ccd/query/arithmetic.hpp), which conversions from
/// and to double need.
struct MpfrArithmetic {
  explicit MpfrArithmetic(int epsilon_exponent) : precision(1 - epsilon_exponent) {}
  PlainArithmetic guard;
  MpfrFloat::PrecisionScope precision;
};

}  // namespace

static_assert(most_bits <= MpfrFloat::most);

Scalar bits_scalar(int bits) {
  return {fmt::format("p{}", bits), 1 - bits, &make_scaled<MpfrFloat, MpfrArithmetic>};
}

}  // namespace nearmiss::ladder
