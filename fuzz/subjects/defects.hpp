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

/// A defective subject: the real code of a sound subject, with one step left out or one tolerance changed.
struct Defect {
  std::string name;  ///< "defect:vv"
  std::string about;
};

/// All defects. A defect of wang multiplies one tolerance by 1/2, 1/10, 1/100 or 0 (or by 10 or 100, if the
/// tolerance excludes degenerate primitives), leaves out one step, or computes in float instead of double. A
/// defect of wang-time or advance leaves out one step, or computes the time in float.
std::span<const Defect> defects();

/// The tolerances by name.
struct NamedTolerance {
  std::string_view name;
  double Tolerances<double>::*value;
  int dimension;  ///< the tolerance is a length to this power
  bool accepts;   ///< whether a larger value accepts more pairs; otherwise, the tolerance excludes degenerate
                  ///< primitives
};
std::span<const NamedTolerance> named_tolerances();

/// The name of the defect that multiplies a tolerance: "defect:mu*0.5".
std::string scaled_tolerance(std::string_view tolerance, double factor);

/// Makes a defect from its name; a tolerance may have any factor >= 0. The defect makes the promises of the
/// sound subject: its distance bound and its sort of time. If the defect changes a tolerance,
/// needed_tolerance() gives the factor by which this tolerance must be multiplied (if larger values accept
/// more pairs) or divided. Returns null for a name that does not start with "defect:". Throws Error for an
/// unknown defect.
std::unique_ptr<Subject> try_make_defect(std::string_view name);

}  // namespace nearmiss
