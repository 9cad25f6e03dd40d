// Mutation of stores: bytes changed at random would hardly ever get past the checksums.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "fuzz/random.hpp"

namespace nearmiss::libfuzzer {

/// Changes a few bytes.
using MutateBytes = std::function<std::string(std::string_view)>;

/// Changes cells, rows or tables of a store, and in most cases corrects its checksums and numbers of rows. If
/// SQLite cannot read the file, and in one case of 16, changes its bytes instead.
std::string mutated_store(Random& random, std::string_view store, const MutateBytes& mutate_bytes);

}  // namespace nearmiss::libfuzzer
