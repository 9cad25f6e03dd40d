// Compiled without coverage: where the compiler itself names the ends of the section of the counters, it
// takes these names for others.
#include "fuzz/libfuzzer/untraced.hpp"

#include <algorithm>

// The linker's names for the ends of the section that has the counters of all code that is run through.
extern "C" std::uint8_t __start___sancov_cntrs[], __stop___sancov_cntrs[];

namespace nearmiss::libfuzzer {

Untraced::Untraced() : counters_(__start___sancov_cntrs, __stop___sancov_cntrs) {}

Untraced::~Untraced() { std::copy(counters_.begin(), counters_.end(), __start___sancov_cntrs); }

}  // namespace nearmiss::libfuzzer
