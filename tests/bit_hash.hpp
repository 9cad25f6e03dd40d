// A hash of numbers, with which tests check that random data stays the same.
#pragma once

#include <bit>
#include <cstdint>

namespace nearmiss::testing {

class BitHash {
 public:
  void add(std::uint64_t bits) { hash_ = std::rotl((hash_ ^ bits) * 0x100000001b3, 29); }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(int number) { add(static_cast<std::uint64_t>(number)); }
  template <class Numbers>
  void add_all(const Numbers& numbers) {
    for (const auto number : numbers) add(number);
  }
  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0;
};

}  // namespace nearmiss::testing
