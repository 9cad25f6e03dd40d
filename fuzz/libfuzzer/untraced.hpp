// Calls that libFuzzer must not see.
#pragma once

#include <cstdint>
#include <vector>

namespace nearmiss::libfuzzer {

/// While an object of this class exists, calls leave no trace in the coverage that libFuzzer sees.
class Untraced {
 public:
  Untraced();
  Untraced(const Untraced&) = delete;
  Untraced& operator=(const Untraced&) = delete;
  ~Untraced();

 private:
  std::vector<std::uint8_t> counters_;
};

/// Calls `ask`, and hides the coverage of this call from libFuzzer. Targets use this function to call code
/// that is not on trial, which in most targets is the oracle. Exact arithmetic has many branches. Without
/// this function, libFuzzer would follow these branches instead of the subject's branches, and would take
/// several times longer.
template <class Ask>
auto untraced(const Ask& ask) {
  const Untraced guard;
  return ask();
}

}  // namespace nearmiss::libfuzzer
