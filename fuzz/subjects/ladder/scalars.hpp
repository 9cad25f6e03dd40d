// The scalars in which basic, wang and wang-tight can compute, as subjects "NAME:SCALAR".
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ccd/query/scalar_name.hpp"
#include "ccd/subjects/subject.hpp"

namespace nearmiss {

namespace ladder {

enum class Algorithm : std::uint8_t { basic, wang, wang_tight };

struct Scalar {
  std::string name;
  int epsilon_exponent;  ///< the exponent in ε = 2^epsilon_exponent
  std::unique_ptr<Subject> (*make)(std::string_view subject, int epsilon_exponent, Algorithm algorithm,
                                   std::optional<double> given_bound);
};

/// The scalar with this number of bits, such as "p40".
Scalar bits_scalar(int bits);

/// The scalar "dd-normals": double, with double-double for normals and weights. named_scalars(), which is
/// ordered by precision, omits this scalar, because it has the same ε as double.
Scalar double_with_wide_normals();

}  // namespace ladder

inline constexpr SubjectInfo dd_normals_info{
    "wang:dd-normals", "wang-scalar with normals and barycentric weights in double-double, all but exact"};

/// The scalars that have a name of their own, in the order of ascending precision. The list does not contain
/// "p16" to "p256", which bits_scalar() makes.
std::vector<ladder::Scalar> named_scalars();

/// Makes basic, wang or wang-tight over a scalar, from a name such as "wang:p40". `given_bound` means the
/// same as for make_subject. Returns null if both the algorithm and the scalar are unknown. Throws Error if
/// only one of the two is unknown.
std::unique_ptr<Subject> try_make_scaled(std::string_view name, std::optional<double> given_bound);

}  // namespace nearmiss
