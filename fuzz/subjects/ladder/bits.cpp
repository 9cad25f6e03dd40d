#include "fuzz/subjects/ladder/bits.hpp"

#include <fmt/format.h>

#include "fuzz/subjects/ladder/scaled_subject.hpp"

namespace nearmiss::ladder {

/// The thread's numbers have as many bits as ε says. Doubles come and go by the processor's arithmetic.
template <>
struct Setting<Bits> {
  explicit Setting(int epsilon_exponent) : precision(1 - epsilon_exponent) {}
  PlainArithmetic guard;
  Bits::Precision precision;
};

static_assert(most_bits <= Bits::most);

Scalar bits_scalar(int bits) { return {fmt::format("p{}", bits), 1 - bits, &make_scaled<Bits>}; }

}  // namespace nearmiss::ladder
