// CCDs with one known defect each: whoever claims to find failures can be asked to find these.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "ccd/subject.hpp"
#include "ccd/tolerances.hpp"

namespace nearmiss {

/// The failure-proof CCD but for one thing: its real code with a step left out or a tolerance changed.
struct Defect {
  std::string name;  ///< "defect:vv"
  std::string about;
};

/// The library: every tolerance times 1/2, 1/10, 1/100 and 0, those that keep degenerate primitives out also
/// times 10 and 100, every step left out, and float in the place of double.
std::span<const Defect> defects();

/// The tolerances by name.
struct NamedTolerance {
  std::string_view name;
  double Tolerances<double>::*value;
  int dimension;  ///< it is a length to this power
  bool accepts;   ///< more is accepted where it is larger; the others keep degenerate primitives out
};
std::span<const NamedTolerance> named_tolerances();

/// The name of the defect that multiplies a tolerance: "defect:mu*0.5".
std::string scaled_tolerance(std::string_view tolerance, double factor);

/// A defect by its name, which may also be that of a tolerance times any factor >= 0. It claims wang's
/// distance bound; its needed tolerance is that of the one that is changed, where there is one: the factor
/// that loosens it (multiplies it where it accepts, divides it else). Nothing for a name that does not start
/// with "defect:"; throws Error for one that is not known.
std::unique_ptr<Subject> try_make_defect(std::string_view name);

}  // namespace nearmiss
