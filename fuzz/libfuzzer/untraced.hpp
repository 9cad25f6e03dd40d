// Calls that libFuzzer is not to see.
#pragma once

#include <cstdint>
#include <vector>

namespace nearmiss::libfuzzer {

/// What is called while one of these exists leaves no trace in the coverage that libFuzzer sees.
class Untraced {
 public:
  Untraced();
  Untraced(const Untraced&) = delete;
  Untraced& operator=(const Untraced&) = delete;
  ~Untraced();

 private:
  std::vector<std::uint8_t> counters_;
};

/// The oracle's answer, or what else a target asks beside the one that is on trial. Exact arithmetic has so
/// many ways that a hunter would follow those instead of the subject's, and take several times as long.
template <class Ask>
auto untraced(const Ask& ask) {
  const Untraced guard;
  return ask();
}

}  // namespace nearmiss::libfuzzer
