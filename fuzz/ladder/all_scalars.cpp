// The whole ladder, which takes long to compile; libFuzzer's targets have one of their own.
#include <algorithm>

#include "fuzz/ladder/scalars.hpp"

namespace nearmiss {

std::vector<ladder::Scalar> scalars() {
  std::vector<ladder::Scalar> all;
  for (const auto part : {ladder::machine_scalars(), ladder::quad_scalar(), ladder::scalars_to_48_bits(),
                          ladder::scalars_to_96_bits(), ladder::scalars_to_256_bits()})
    all.insert(all.end(), part.begin(), part.end());
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.epsilon_exponent > b.epsilon_exponent; });
  return all;
}

}  // namespace nearmiss
