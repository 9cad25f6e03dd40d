// The only source of random numbers. Each number is a function of a key and a counter. No state is carried
// over from one query to the next.
#pragma once

// Philox, the generator that this file uses, needs no SSE instructions. The header that declares these
// instructions takes more than a second to compile.
#define R123_USE_SSE 0
#include <Random123/philox.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// A sequence of random numbers that depends only on (seed, stream, index): Philox4x64-10 with the key (seed,
/// stream) and the counter (index, number of the draw / 4). Vector instructions would not help, because they
/// cannot compute the 128-bit product of two 64-bit integers: with vector instructions, eight streams took
/// 1.6 times as long as without.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t stream, std::uint64_t index)
      : key_{{seed, stream}}, index_(index) {}

  std::uint64_t bits() {
    if (used_ == 4) {
      block_ = next_block();
      used_ = 0;
    }
    return block_[used_++];
  }

  /// A uniform multiple of 2^-53 in [0, 1).
  double uniform() { return fraction(bits()); }
  /// The next n results of uniform(), in less time than n calls take.
  template <std::size_t n>
  std::array<double, n> uniforms() {
    std::array<double, n> all;
    std::size_t i = 0;
    while (i < n && used_ < 4) all[i++] = uniform();
    for (; i + 4 <= n; i += 4) {
      const auto block = next_block();
      for (std::size_t k = 0; k < 4; ++k) all[i + k] = fraction(block[k]);
    }
    while (i < n) all[i++] = uniform();
    return all;
  }
  double uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }
  /// A log-uniform number in [lo, hi), for positive lo and hi. The last bit of the result depends on exp and
  /// log of the C library. On processors without fused multiply-add, these functions may return other
  /// results.
  double log_uniform(double lo, double hi) { return std::exp(uniform(std::log(lo), std::log(hi))); }
  /// A random integer in [lo, hi]. Each integer has the probability 1 / (hi - lo + 1), up to an error below
  /// 2^-32.
  int integer(int lo, int hi) {
    const auto range = static_cast<std::uint64_t>(hi - lo) + 1;
    return lo + static_cast<int>(((bits() >> 32) * range) >> 32);
  }
  /// True with probability 1 / n.
  bool one_in(int n) { return integer(1, n) == 1; }

  /// A vector with components uniform in [-size, size).
  Vector3<double> vector(double size) {
    const double x = uniform(-size, size);
    const double y = uniform(-size, size);
    const double z = uniform(-size, size);
    return {x, y, z};
  }
  /// A vector whose components are integers in [-size, size].
  Vector3<double> integer_vector(int size) {
    const int x = integer(-size, size);
    const int y = integer(-size, size);
    const int z = integer(-size, size);
    return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
  }

 private:
  static double fraction(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

  r123::Philox4x64::ctr_type next_block() {
    return r123::Philox4x64()({{index_, block_number_++, 0, 0}}, key_);
  }

  r123::Philox4x64::key_type key_;
  std::uint64_t index_;
  std::uint64_t block_number_ = 0;
  r123::Philox4x64::ctr_type block_{};
  unsigned used_ = 4;
};

}  // namespace nearmiss
