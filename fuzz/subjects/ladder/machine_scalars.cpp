// Scalars of the machine, and two doubles. IEEE 754's operations and root, to nearest (`MachineArithmetic`), are the
// exact ones times 1 + d, |d| <= u = ε/2, as long as nothing over- or underflows: `in_range` (ccd/motion.hpp)
// sees to that. So do x87's with 64 bits, which long double has; double-double has an ε of its own.
#include "fuzz/subjects/ladder/double_double.hpp"
#include "fuzz/subjects/ladder/scaled_subject.hpp"

namespace nearmiss::ladder {

namespace {

template <class T>
Scalar scalar(std::string name) {
  return {std::move(name), epsilon_exponent<T>, &make_scaled<T>};
}

}  // namespace

std::vector<Scalar> machine_scalars() {
  return {scalar<float>("float"), scalar<double>("double"), scalar<long double>("longdouble"),
          scalar<DoubleDouble>("dd")};
}

}  // namespace nearmiss::ladder
