// Makes Lanes usable as the number type of polynomials and of their bounds.
#pragma once

#include "ccd/query/lanes.hpp"
#include "oracle/arithmetic/bernstein.hpp"

namespace nearmiss {

template <int n>
Lanes<n> approximate(const Lanes<n>& x) {
  return x;
}

namespace certified {

template <int n>
inline constexpr double roundoff<Lanes<n>> = roundoff<double>;

template <int n>
struct BoundOf<Lanes<n>> {
  using Type = Lanes<n>;
};

}  // namespace certified
}  // namespace nearmiss
