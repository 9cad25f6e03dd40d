#include "fuzz/ladder/bits.hpp"

namespace nearmiss::ladder {

namespace {

constexpr std::array all{bits_scalar<104>("p104"), bits_scalar<112>("p112"), bits_scalar<113>("p113"),
                         bits_scalar<128>("p128"), bits_scalar<160>("p160"), bits_scalar<192>("p192"),
                         bits_scalar<224>("p224"), bits_scalar<256>("p256")};

}  // namespace

std::span<const Scalar> scalars_to_256_bits() { return all; }

}  // namespace nearmiss::ladder
