// The number types of the templates: a scalar, or several scalars side by side.
#pragma once

#include <type_traits>

namespace nearmiss {

/// The type of the scalars that a T holds: T itself, unless T holds several and has a specialisation
/// (lanes.hpp).
template <class T>
struct ScalarIn {
  using Type = T;
};

template <class T>
using ScalarOf = typename ScalarIn<T>::Type;

template <class T>
inline constexpr bool is_scalar = std::is_same_v<ScalarOf<T>, T>;

}  // namespace nearmiss
