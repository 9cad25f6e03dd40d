// The scalars over which the subjects of ccd/ can compute: subjects "NAME:SCALAR".
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ccd/subject.hpp"

namespace nearmiss {

namespace ladder {

enum class Algorithm : std::uint8_t { basic, wang, wang_tight };

struct Scalar {
  std::string name;
  int epsilon_exponent;  ///< ε = 2^this
  std::unique_ptr<Subject> (*make)(std::string_view subject, int epsilon_exponent, Algorithm algorithm,
                                   std::optional<double> given_bound);
};

/// The parts of the list, each from its own file. quad_scalar() is empty if the compiler has no binary128.
std::vector<Scalar> machine_scalars();
std::vector<Scalar> quad_scalar();
/// The scalar with this number of bits: "p40".
Scalar bits_scalar(int bits);

inline constexpr int fewest_bits = 16, most_bits = 256;

}  // namespace ladder

/// The scalars with their own name, by ascending precision. There are also "p16" to "p256".
std::vector<ladder::Scalar> named_scalars();

/// basic, wang or wang-tight over a scalar: "wang:p40". Nothing for a name without a colon. `given_bound` as for
/// make_subject. Throws Error for an unknown algorithm or scalar.
std::unique_ptr<Subject> try_make_scaled(std::string_view name, std::optional<double> given_bound);

}  // namespace nearmiss
