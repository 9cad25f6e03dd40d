// Many doubles side by side, in the vector registers of the processor.
#pragma once

#include <Eigen/Core>

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <experimental/simd>
#include <utility>

#include "ccd/scalar.hpp"

#if defined __clang__ && defined __AVX512F__
#include <immintrin.h>
#endif

namespace nearmiss {

/// n doubles; every operation acts on each of them as on a double. For n = 2, 4 and 8 they fill a register if the code that
/// uses them is compiled for these instructions.
template <int n>
using Lanes = std::experimental::simd<double, std::experimental::simd_abi::deduce_t<double, n>>;

template <class Abi>
struct ScalarIn<std::experimental::simd<double, Abi>> {
  using Type = double;
};

/// a in lanes in which the mask is true, else b.
template <class Real>
[[gnu::always_inline]] inline Real select(const typename Real::mask_type& mask, const Real& a,
                                          const Real& b) {
#if defined __clang__ && defined __AVX512F__ && defined __AVX512VL__
  // Compiled by clang, where() of libstdc++ 12 assigns to the wrong lanes if masks are those of AVX-512.
  constexpr std::size_t n = Real::size();
  const auto bits = static_cast<__mmask8>(mask.__to_bitset().to_ulong());
  if constexpr (n == 2)
    return std::bit_cast<Real>(_mm_mask_blend_pd(bits, std::bit_cast<__m128d>(b), std::bit_cast<__m128d>(a)));
  if constexpr (n == 4)
    return std::bit_cast<Real>(
        _mm256_mask_blend_pd(bits, std::bit_cast<__m256d>(b), std::bit_cast<__m256d>(a)));
  if constexpr (n == 8)
    return std::bit_cast<Real>(
        _mm512_mask_blend_pd(bits, std::bit_cast<__m512d>(b), std::bit_cast<__m512d>(a)));
#endif
  Real selected = b;
  where(mask, selected) = a;
  return selected;
}

/// number(0), number(1), ...
template <class Real, class Number>
[[gnu::always_inline]] inline Real gather(const Number& number) {
  return Real([&](auto lane) { return number(static_cast<std::size_t>(lane)); });
}

/// The compiler's vector of n doubles.
template <int n>
struct Register {
  using Doubles [[gnu::vector_size(n * sizeof(double))]] = double;
  Doubles v;
};

/// The numbers of a row in the first lane, those of the next row in the second lane, ...: n numbers of each of n rows.
template <int n, class Row>
[[gnu::always_inline]] inline void load_transposed(const Row& row, Lanes<n>* columns) {
  std::array<Register<n>, n> rows;
  for (std::size_t i = 0; i < n; ++i) std::memcpy(&rows[i], row(i), sizeof(rows[i]));
  const auto swap_blocks = [&]<std::size_t size, std::size_t... j>(std::index_sequence<size>,
                                                                   std::index_sequence<j...>) {
    // In each block of 2 × 2 blocks of this size, the upper right one and the lower left one change places.
    for (std::size_t i = 0; i < n; ++i) {
      if ((i & size) != 0) continue;
      const auto [upper] = rows[i];
      const auto [lower] = rows[i + size];
      rows[i].v = __builtin_shufflevector(upper, lower, ((j & size) == 0 ? j : n + j - size)...);
      rows[i + size].v = __builtin_shufflevector(upper, lower, ((j & size) == 0 ? j + size : n + j)...);
    }
  };
  constexpr auto columns_of_row = std::make_index_sequence<n>();
  if constexpr (n >= 8) swap_blocks(std::index_sequence<4>(), columns_of_row);
  if constexpr (n >= 4) swap_blocks(std::index_sequence<2>(), columns_of_row);
  swap_blocks(std::index_sequence<1>(), columns_of_row);
  for (std::size_t i = 0; i < n; ++i) columns[i] = std::bit_cast<Lanes<n>>(rows[i]);
}

}  // namespace nearmiss

/// Eigen's vectors of lanes.
template <class Abi>
struct Eigen::NumTraits<std::experimental::simd<double, Abi>>
    : Eigen::GenericNumTraits<std::experimental::simd<double, Abi>> {
  using Real = std::experimental::simd<double, Abi>;
  using NonInteger = Real;
  using Literal = Real;
  using Nested = Real;
  enum {
    IsInteger = 0,
    IsSigned = 1,
    IsComplex = 0,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};
