// Included first by every C++ file of the copy that contains the mutants, and by nothing else. One mutant at a time is switched on, by
// the environment variable NEARMISS_MUTANT; NEARMISS_MUTANTS_REACHED names a file, one byte a mutant, where those that are evaluated are marked.
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

/// The marks, shared by all processes of a run, so that they survive however a process ends; or null.
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

/// Whether mutant k is switched on. Not for constants: what needs it at compile time does not compile.
inline bool now(int k) {
  if (reached != nullptr && reached[k] == 0) reached[k] = 1;
  return k == on;
}

/// The same in constexpr functions: no mutant is on while these are evaluated at compile time.
constexpr bool mutant(int k) { return !std::is_constant_evaluated() && now(k); }

/// The value of an expression; that of an expression template of Eigen, evaluated.
template <class T>
constexpr auto value(T&& x) {
  if constexpr (requires { typename std::remove_cvref_t<T>::PlainObject; })
    return typename std::remove_cvref_t<T>::PlainObject(std::forward<T>(x));
  else
    return std::remove_cvref_t<T>(std::forward<T>(x));
}

/// What one of two functions gives, which differ in type as expression templates do.
template <class Mutant, class Original>
constexpr auto choose(bool mutant, Mutant&& changed, Original&& original) -> decltype(original()) {
  if (mutant) return changed();
  return original();
}

}  // namespace mutants
