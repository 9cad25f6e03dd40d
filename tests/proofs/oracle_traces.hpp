// Lets the oracle's templates compute with Traced, to record the computation of F, of the weights, and of
// their bounds.
#pragma once

#include <cctype>
#include <string>

#include "oracle/filter/step_part.hpp"
#include "tests/proofs/traced.hpp"

namespace nearmiss::proofs {

/// A double word as a traced expression. It has the operations of Traced, with the errors of double words.
struct TracedWord {
  Traced x;

  TracedWord() = default;
  TracedWord(double constant) : x(constant) {}
  TracedWord(Traced expression) : x(std::move(expression)) {}

  friend TracedWord operator+(const TracedWord& a, const TracedWord& b) { return a.x + b.x; }
  friend TracedWord operator-(const TracedWord& a, const TracedWord& b) { return a.x - b.x; }
  friend TracedWord operator*(const TracedWord& a, const TracedWord& b) { return a.x * b.x; }
  friend TracedWord operator/(const TracedWord& a, double b) { return a.x / b; }
};

inline Traced approximate(const Traced& x) { return x; }
inline Traced approximate(const TracedWord& x) { return x.x; }

}  // namespace nearmiss::proofs

namespace nearmiss::certified {

template <>
inline constexpr double roundoff<proofs::Traced> = roundoff<double>;
template <>
inline constexpr double roundoff<proofs::TracedWord> = roundoff<DoubleWord>;
template <>
inline constexpr double product_underflow<proofs::Traced> = product_underflow<double>;
template <>
inline constexpr double product_underflow<proofs::TracedWord> = product_underflow<DoubleWord>;
template <>
struct BoundOf<proofs::Traced> {
  using Type = proofs::Traced;
};
template <>
struct BoundOf<proofs::TracedWord> {
  using Type = proofs::Traced;
};

}  // namespace nearmiss::certified

namespace nearmiss::proofs {

/// The components of the vectors are the leaves of all expressions. The enumerator says how much the computed
/// components differ from the exact components.
enum class Leaves {
  exact,         ///< no difference
  rounded_once,  ///< a factor of 1 ± U
  given_errors,  ///< at most `error`
};

/// A moving vector of inputs. A component is named after the vector, the end of the step and the axis: "a0x".
/// Its magnitude is "Ax", and its error is "eax".
template <class Real>
certified::Motion<Real> traced_motion(Trace& trace, char name, Leaves leaves) {
  certified::Motion<Real> motion;
  motion.rounded_once = leaves == Leaves::rounded_once;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string axis(1, "xyz"[k]);
    const auto input = [&](const std::string& full) { return trace.input(full + axis, 1); };
    motion.start[k] = input(std::string(1, name) + "0");
    motion.end[k] = input(std::string(1, name) + "1");
    motion.magnitude[k] = input(std::string(1, static_cast<char>(std::toupper(name))));
    motion.error[k] = leaves == Leaves::given_errors ? input(std::string("e") + name) : Traced(0);
  }
  return motion;
}

inline bool is_component(const std::string& input) {
  return input.size() == 3 && (input[1] == '0' || input[1] == '1');
}
inline std::string magnitude_of(const std::string& input) {
  if (!is_component(input)) return input;
  return {static_cast<char>(std::toupper(input[0])), input[2]};
}
inline std::string error_of(const std::string& component) { return {'e', component[0], component[2]}; }

}  // namespace nearmiss::proofs
