#include "fuzz/ladder/bits.hpp"

namespace nearmiss::ladder {

namespace {

constexpr std::array all{bits_scalar<53>("p53"), bits_scalar<56>("p56"), bits_scalar<60>("p60"),
                         bits_scalar<64>("p64"), bits_scalar<72>("p72"), bits_scalar<80>("p80"),
                         bits_scalar<88>("p88"), bits_scalar<96>("p96")};

}  // namespace

std::span<const Scalar> scalars_to_96_bits() { return all; }

}  // namespace nearmiss::ladder
