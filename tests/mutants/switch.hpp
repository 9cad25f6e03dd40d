// Every C++ file of the copy that contains the mutants includes this file first; no other file does. The
// environment variable NEARMISS_MUTANT switches one mutant on. NEARMISS_MUTANTS_REACHED names a file with one
// byte for each mutant. If the program evaluates a mutant, its byte becomes 1.
#pragma once
#include <fcntl.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#include <type_traits>
#include <utility>

namespace mutants {

constexpr int most = 4096;

inline int chosen() {
  const char* text = getenv("NEARMISS_MUTANT");
  return text != nullptr ? atoi(text) : 0;
}

/// The bytes of the file of reached mutants, or null without a file. All processes of a run share them in
/// memory, so that they survive however a process ends.
inline unsigned char* marks() {
  const char* file = getenv("NEARMISS_MUTANTS_REACHED");
  if (file == nullptr) return nullptr;
  const int descriptor = open(file, O_RDWR | O_CLOEXEC);
  if (descriptor < 0) return nullptr;
  void* map = mmap(nullptr, most, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  close(descriptor);
  return map == MAP_FAILED ? nullptr : static_cast<unsigned char*>(map);
}

inline const int on = chosen();
inline unsigned char* const reached = marks();

/// Whether mutant k is switched on. Code that must be evaluated at compile time cannot call this function.
inline bool now(int k) {
  if (reached != nullptr && reached[k] == 0) reached[k] = 1;
  return k == on;
}

/// Does what `now` does, for constexpr functions. At compile time, no mutant is on.
constexpr bool mutant(int k) { return !__builtin_is_constant_evaluated() && now(k); }

/// The type of a value; for an expression template of Eigen, that of its result.
template <class T, class = void>
struct TypeOf {
  using type = T;
};
template <class T>
struct TypeOf<T, std::void_t<typename T::PlainObject>> {
  using type = typename T::PlainObject;
};

/// The value of an expression. An expression template of Eigen is evaluated.
template <class T>
constexpr auto value(T&& x) {
  return typename TypeOf<std::remove_cv_t<std::remove_reference_t<T>>>::type(std::forward<T>(x));
}

/// The result of one of two functions. Their return types may differ, as those of expression templates do.
template <class Mutant, class Original>
constexpr auto choose(bool mutant, Mutant&& changed, Original&& original) -> decltype(original()) {
  if (mutant) return changed();
  return original();
}

}  // namespace mutants
