// What the templates compute with: a scalar, or many side by side.
#pragma once

#include <type_traits>

namespace nearmiss {

/// The scalar of which a type has one or more; a type of many has its own specialisation (lanes.hpp).
template <class T>
struct ScalarIn {
  using Type = T;
};

template <class T>
using ScalarOf = typename ScalarIn<T>::Type;

template <class T>
inline constexpr bool is_scalar = std::is_same_v<ScalarOf<T>, T>;

}  // namespace nearmiss
