#include "fuzz/ladder/bits.hpp"

namespace nearmiss::ladder {

namespace {

constexpr std::array all{bits_scalar<16>("p16"), bits_scalar<20>("p20"), bits_scalar<24>("p24"),
                         bits_scalar<28>("p28"), bits_scalar<32>("p32"), bits_scalar<36>("p36"),
                         bits_scalar<40>("p40"), bits_scalar<44>("p44"), bits_scalar<48>("p48")};

}  // namespace

std::span<const Scalar> scalars_to_48_bits() { return all; }

}  // namespace nearmiss::ladder
