// This file is compiled without coverage. With coverage, the compiler itself would declare the two names
// below, and its declarations would conflict with the declarations here. If no file of the program has
// coverage, the names are undefined, and their addresses are null.
#include "fuzz/libfuzzer/untraced.hpp"

#include <algorithm>

// The linker's names for the start and the end of the section with the coverage counters.
extern "C" [[gnu::weak]] std::uint8_t __start___sancov_cntrs[], __stop___sancov_cntrs[];

namespace nearmiss::libfuzzer {

Untraced::Untraced() : counters_(__start___sancov_cntrs, __stop___sancov_cntrs) {}

Untraced::~Untraced() { std::copy(counters_.begin(), counters_.end(), __start___sancov_cntrs); }

}  // namespace nearmiss::libfuzzer
