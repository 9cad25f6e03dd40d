// The scalars whose operations the processor computes, and double-double. Under `MachineArithmetic`, which
// rounds to nearest, every operation of IEEE 754, including the square root, gives the exact result times 1 +
// d with |d| <= u = ε/2, unless the operation overflows or underflows; `in_range` (ccd/wang/motion.hpp)
// excludes both. double_double.hpp has the bounds for double-double.
#include "fuzz/subjects/ladder/double_double.hpp"
#include "fuzz/subjects/ladder/scaled_subject.hpp"

namespace nearmiss {

namespace {

template <class T>
ladder::Scalar scalar(std::string name) {
  return {std::move(name), epsilon_exponent<T>, &ladder::make_scaled<T>};
}

}  // namespace

ladder::Scalar ladder::double_with_wide_normals() {
  return {"dd-normals", epsilon_exponent<double>, &make_scaled<double, MachineArithmetic, DoubleDouble>};
}

std::vector<ladder::Scalar> named_scalars() {
  return {scalar<float>("float"), scalar<double>("double"), scalar<DoubleDouble>("dd")};
}

}  // namespace nearmiss
