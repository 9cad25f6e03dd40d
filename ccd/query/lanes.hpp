// Vectors of doubles, in the vector registers of the processor.
#pragma once

#include <Eigen/Core>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

#include "ccd/query/scalar.hpp"

namespace nearmiss {

/// A vector of n doubles, which are called its lanes. An operation acts on each lane as it acts on a double.
/// With n = 2, 4 or 8, the compiler keeps a vector in an SSE2, AVX or AVX-512 register if it compiles for
/// that instruction set.
template <int n>
struct Lanes {
  using Vector [[gnu::vector_size(n * sizeof(double))]] = double;
  using Integers [[gnu::vector_size(n * sizeof(double))]] = std::int64_t;

  /// True or false in each lane.
  struct Mask {
    Integers bits{};

    Mask() = default;
    explicit Mask(const Integers& of_lanes) : bits(of_lanes) {}
    explicit Mask(bool same) : bits(Integers{} - (same ? 1 : 0)) {}

    friend Mask operator&(const Mask& a, const Mask& b) { return Mask(a.bits & b.bits); }
    friend Mask operator|(const Mask& a, const Mask& b) { return Mask(a.bits | b.bits); }
    friend Mask operator==(const Mask& a, const Mask& b) { return Mask(~(a.bits ^ b.bits)); }
    friend Mask operator!=(const Mask& a, const Mask& b) { return Mask(a.bits ^ b.bits); }
    friend Mask operator!(const Mask& a) { return Mask(~a.bits); }
    bool operator[](std::size_t lane) const { return std::bit_cast<EachInteger>(bits)[lane] != 0; }
    /// Integers that are `number` in the lanes in which the mask is true, and 0 in the other lanes.
    [[nodiscard]] Integers as(std::int64_t number) const { return bits & number; }

    friend bool any_of(const Mask& a) {
      std::int64_t any = 0;
      for (const std::int64_t of_lane : std::bit_cast<EachInteger>(a.bits)) any |= of_lane;
      return any != 0;
    }

   private:
    using EachInteger = std::array<std::int64_t, n>;
  };

  Vector v;

  Lanes() = default;
  Lanes(double x) : v(x - Vector{}) {}
  explicit Lanes(const Vector& of_lanes) : v(of_lanes) {}

  static Lanes load(const double* from) {
    Lanes lanes;
    std::memcpy(&lanes.v, from, sizeof(lanes.v));
    return lanes;
  }
  void store(double* to) const { std::memcpy(to, &v, sizeof(v)); }
  /// Lanes with the values number(0), number(1), ...
  template <class Number>
  static Lanes gather(const Number& number) {
    std::array<double, n> numbers;
    for (std::size_t lane = 0; lane < n; ++lane) numbers[lane] = number(lane);
    return load(numbers.data());
  }
  double operator[](std::size_t lane) const { return std::bit_cast<std::array<double, n>>(v)[lane]; }

  friend Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(a.v + b.v); }
  friend Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(a.v - b.v); }
  friend Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(a.v * b.v); }
  friend Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes(a.v / b.v); }
  Lanes operator-() const { return Lanes(-v); }
  Lanes& operator+=(const Lanes& b) { return *this = *this + b; }
  Lanes& operator-=(const Lanes& b) { return *this = *this - b; }
  Lanes& operator*=(const Lanes& b) { return *this = *this * b; }
  Lanes& operator/=(const Lanes& b) { return *this = *this / b; }

  friend Mask operator<(const Lanes& a, const Lanes& b) { return Mask(a.v < b.v); }
  friend Mask operator>(const Lanes& a, const Lanes& b) { return Mask(a.v > b.v); }
  friend Mask operator<=(const Lanes& a, const Lanes& b) { return Mask(a.v <= b.v); }
  friend Mask operator>=(const Lanes& a, const Lanes& b) { return Mask(a.v >= b.v); }
  friend Mask operator==(const Lanes& a, const Lanes& b) { return Mask(a.v == b.v); }
  friend Mask operator!=(const Lanes& a, const Lanes& b) { return Mask(a.v != b.v); }

  /// The values of `a` in the lanes in which the mask is true, and the values of `b` in the other lanes.
  friend Lanes select(const Mask& mask, const Lanes& a, const Lanes& b) {
    return Lanes(mask.bits ? a.v : b.v);
  }
  friend Lanes max(const Lanes& a, const Lanes& b) { return Lanes(a.v < b.v ? b.v : a.v); }
  friend Lanes min(const Lanes& a, const Lanes& b) { return Lanes(b.v < a.v ? b.v : a.v); }
  friend Lanes abs(const Lanes& a) {
    const Integers bits = reinterpret_cast<Integers>(a.v) & std::numeric_limits<std::int64_t>::max();
    return Lanes(reinterpret_cast<Vector>(bits));
  }
  friend Lanes sqrt(const Lanes& a) {
    return gather([&](std::size_t lane) { return std::sqrt(a[lane]); });
  }

  /// Transposes the n × n matrix whose rows are rows[0] .. rows[n - 1].
  static void transpose(Lanes* rows) { transpose<n / 2>(rows); }

 private:
  /// Transposes each block of 2s × 2s numbers: exchanges the block's two off-diagonal quarters, then
  /// transposes all four quarters by calling itself for s/2.
  template <int s>
  static void transpose(Lanes* rows) {
    for (int i = 0; i < n; ++i)
      if ((i & s) == 0) exchange<s>(rows[i], rows[i + s], std::make_integer_sequence<int, n>());
    if constexpr (s > 1) transpose<s / 2>(rows);
  }
  template <int s, int... j>
  static void exchange(Lanes& upper, Lanes& lower, std::integer_sequence<int, j...>) {
    const Vector u = upper.v;
    const Vector l = lower.v;
    upper.v = __builtin_shufflevector(u, l, ((j & s) == 0 ? j : n + j - s)...);
    lower.v = __builtin_shufflevector(u, l, ((j & s) == 0 ? j + s : n + j)...);
  }
};

template <int n>
struct ScalarIn<Lanes<n>> {
  using Type = double;
};

}  // namespace nearmiss

/// Lets the components of Eigen's vectors be of the type Lanes.
template <int n>
struct Eigen::NumTraits<nearmiss::Lanes<n>> : Eigen::GenericNumTraits<nearmiss::Lanes<n>> {
  using Real = nearmiss::Lanes<n>;
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
