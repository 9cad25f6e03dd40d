// CCDs with one known defect each, to measure whether a hunt finds the defect.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "ccd/subjects/subject.hpp"
#include "ccd/wang/tolerances.hpp"

namespace nearmiss {

/// The real code of a sound subject with one step left out or one tolerance changed.
struct Defect {
  std::string name;  ///< "defect:vv"
  std::string about;
};

/// All defects. Those of wang: every tolerance times 1/2, 1/10, 1/100 and 0; tolerances that exclude
/// degenerate primitives also times 10 and 100; every step left out; and float in place of double. Those of
/// wang-time and advance: every step left out, and a time in float.
std::span<const Defect> defects();

/// The tolerances by name.
struct NamedTolerance {
  std::string_view name;
  double Tolerances<double>::*value;
  int dimension;  ///< the tolerance is a length to this power
  bool accepts;   ///< a larger value accepts more; the other tolerances exclude degenerate primitives
};
std::span<const NamedTolerance> named_tolerances();

/// The name of the defect that multiplies a tolerance: "defect:mu*0.5".
std::string scaled_tolerance(std::string_view tolerance, double factor);

/// Makes a defect from its name; a tolerance may have any factor >= 0. The subject promises what the sound
/// one does: its distance bound and its sort of time. If the defect changes a tolerance, needed_tolerance()
/// gives the factor that loosens this tolerance: it multiplies an accepting tolerance and divides any other.
/// Nothing for a name that does not start with "defect:". Throws Error for an unknown defect.
std::unique_ptr<Subject> try_make_defect(std::string_view name);

}  // namespace nearmiss
