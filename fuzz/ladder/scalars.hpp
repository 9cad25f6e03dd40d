// The scalars over which the subjects of ccd/ can compute: subjects "NAME:SCALAR".
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "ccd/subject.hpp"

namespace nearmiss {

namespace ladder {

enum class Algorithm : std::uint8_t { basic, wang, wang_tight };

/// Makes a subject.
using Make = std::unique_ptr<Subject> (*)(std::string_view name, Algorithm algorithm,
                                          std::optional<double> given_bound);

struct Scalar {
  std::string_view name;
  int epsilon_exponent;  ///< ε = 2^this
  Make make;
};

/// The parts of the list, each from a file of its own.
std::span<const Scalar> machine_scalars();
std::span<const Scalar> quad_scalar();
std::span<const Scalar> scalars_to_48_bits();
std::span<const Scalar> scalars_to_96_bits();
std::span<const Scalar> scalars_to_256_bits();

}  // namespace ladder

/// All scalars, by ascending precision.
std::vector<ladder::Scalar> scalars();

/// basic, wang or wang-tight over a scalar, as "wang:p40"; nothing for a name without a colon. A bound as for
/// make_subject. Throws Error for an algorithm or a scalar that is not known.
std::unique_ptr<Subject> try_make_scaled(std::string_view name, std::optional<double> given_bound);

}  // namespace nearmiss
