// Many doubles side by side, for vector instructions.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "oracle/arithmetic/bernstein.hpp"

namespace nearmiss::certified {

/// n doubles; every operation acts on each lane as on a double. They are the compiler's vector types: for n =
/// 2, 4, 8 these are SSE2, AVX and AVX-512 registers if the function that uses them is compiled for that
/// instruction set.
template <int n>
struct Lanes {
  using Vector [[gnu::vector_size(n * sizeof(double))]] = double;
  using IntegerLanes [[gnu::vector_size(n * sizeof(double))]] = std::int64_t;

  /// True or false in each lane.
  struct Mask {
    IntegerLanes bits;

    friend Mask operator&(const Mask& a, const Mask& b) { return {a.bits & b.bits}; }
    friend Mask operator|(const Mask& a, const Mask& b) { return {a.bits | b.bits}; }
    friend Mask operator!(const Mask& a) { return {~a.bits}; }
    /// The number in lanes in which the mask is true, else 0.
    [[nodiscard]] IntegerLanes as(std::int64_t number) const { return bits & number; }
  };

  Vector v;

  Lanes() = default;
  Lanes(double x) : v(x - Vector{}) {}
  explicit Lanes(const Vector& vector) : v(vector) {}

  /// number(0), number(1), ...
  template <class Number>
  static Lanes gather(const Number& number) {
    return gather(number, std::make_index_sequence<n>());
  }
  static Lanes load(const double* from) {
    Lanes lanes;
    std::memcpy(&lanes.v, from, sizeof(lanes.v));
    return lanes;
  }
  void store(double* to) const { std::memcpy(to, &v, sizeof(v)); }

  friend Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(a.v + b.v); }
  friend Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(a.v - b.v); }
  friend Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(a.v * b.v); }
  friend Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes(a.v / b.v); }
  Lanes operator-() const { return Lanes(-v); }
  Lanes& operator+=(const Lanes& b) { return *this = *this + b; }

  friend Mask operator<(const Lanes& a, const Lanes& b) { return {a.v < b.v}; }
  friend Mask operator>(const Lanes& a, const Lanes& b) { return {a.v > b.v}; }

  /// a in lanes in which the mask is true, else b.
  friend Lanes select(const Mask& mask, const Lanes& a, const Lanes& b) {
    return Lanes(mask.bits ? a.v : b.v);
  }
  friend Lanes max(const Lanes& a, const Lanes& b) { return Lanes(a.v < b.v ? b.v : a.v); }
  friend Lanes min(const Lanes& a, const Lanes& b) { return Lanes(b.v < a.v ? b.v : a.v); }
  friend Lanes abs(const Lanes& a) { return max(a, -a); }
  friend Lanes sqrt(const Lanes& a) {
    std::array<double, n> roots;
    a.store(roots.data());
    for (double& x : roots) x = std::sqrt(x);
    return load(roots.data());
  }
  friend Lanes approximate(const Lanes& a) { return a; }

  /// Turns n rows of n numbers into columns.
  static void transpose(Lanes* rows) { transpose<n / 2>(rows); }

 private:
  /// Exchanges the off-diagonal blocks of s × s numbers, then recursively the smaller ones within all blocks.
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

  template <class Number, std::size_t... lane>
  static Lanes gather(const Number& number, std::index_sequence<lane...>) {
    return Lanes(Vector{number(lane)...});
  }
};

template <int n>
inline constexpr double roundoff<Lanes<n>> = roundoff<double>;

template <int n>
struct BoundOf<Lanes<n>> {
  using Type = Lanes<n>;
};

}  // namespace nearmiss::certified
