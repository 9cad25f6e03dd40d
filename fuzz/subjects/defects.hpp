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

/// A defective subject: the real code of a sound subject with one change. A step is left out or wrong, a
/// tolerance is changed, or float replaces double.
struct Defect {
  std::string name;  ///< "defect:vv"
  std::string about;
};

/// All defects. A defect of wang multiplies one tolerance by 1/2, 1/10, 1/100 or 0, gets one step wrong, or
/// computes in float instead of double. A tolerance that excludes degenerate primitives is also multiplied by
/// 10 and 100. A defect of wang-time or advance gets one step wrong; one defect of wang-time computes the
/// time in float instead.
std::span<const Defect> defects();

/// A tolerance of wang, by name.
struct NamedTolerance {
  std::string_view name;
  double Tolerances<double>::*value;
  int dimension;  ///< the tolerance is a length raised to this power
  bool accepts;   ///< whether a larger value lets the CCD accept more pairs; if false, the tolerance excludes
                  ///< degenerate primitives
};
std::span<const NamedTolerance> named_tolerances();

/// The name of the defect that multiplies a tolerance by a factor, such as "defect:mu*0.5".
std::string scaled_tolerance(std::string_view tolerance, double factor);

/// Makes a defective subject from its name. In the name of a tolerance's defect, the factor may be any number
/// that is at least 0. The defective subject promises the same distance bound and the same sort of time as
/// the sound subject. If the defect changes a tolerance, needed_tolerance() gives the factor that loosens
/// this tolerance enough for the subject to report the query. Returns null for a name that does not start
/// with "defect:". Throws Error for an unknown defect.
std::unique_ptr<Subject> try_make_defect(std::string_view name);

}  // namespace nearmiss
