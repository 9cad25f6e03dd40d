// The scalars that libFuzzer's targets have: those of the machine, which are quick to compile and to run.
#include "fuzz/ladder/scalars.hpp"

namespace nearmiss {

std::vector<ladder::Scalar> scalars() {
  const auto few = ladder::machine_scalars();
  return {few.begin(), few.end()};
}

}  // namespace nearmiss
