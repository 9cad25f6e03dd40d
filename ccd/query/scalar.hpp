// The types of numbers with which templates compute: a scalar, or several scalars side by side (Lanes).
#pragma once

#include <type_traits>

namespace nearmiss {

/// The type of the scalars that a number of type T consists of: T itself, unless T has a specialisation, as
/// Lanes has.
template <class T>
struct ScalarIn {
  using Type = T;
};

template <class T>
using ScalarOf = typename ScalarIn<T>::Type;

template <class T>
inline constexpr bool is_scalar = std::is_same_v<ScalarOf<T>, T>;

}  // namespace nearmiss
