// Traits of our scalar classes for Eigen and the standard library.
#pragma once

#include <Eigen/Core>
#include <limits>

namespace nearmiss::ladder {

/// A base class for std::numeric_limits<T>, for a type T whose range is at least the range of double. It
/// gives the limits of double; the derived class replaces epsilon.
template <class T>
struct LimitsOfDouble : std::numeric_limits<double> {
  static T min() { return std::numeric_limits<double>::min(); }
  static T max() { return std::numeric_limits<double>::max(); }
  static T infinity() { return std::numeric_limits<double>::infinity(); }
};

/// A base class for Eigen::NumTraits<T>: T is a type of real numbers that needs its constructor to be called,
/// and the parameters are estimated costs of T's operations.
template <class T, int read_cost, int add_cost, int multiplication_cost>
struct RealTraits : Eigen::GenericNumTraits<T> {
  enum {
    IsInteger = 0,
    IsSigned = 1,
    IsComplex = 0,
    RequireInitialization = 1,
    ReadCost = read_cost,
    AddCost = add_cost,
    MulCost = multiplication_cost
  };
};

}  // namespace nearmiss::ladder
