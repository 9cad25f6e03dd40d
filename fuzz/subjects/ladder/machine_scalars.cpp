// Scalars of the machine, and double-double. IEEE 754's operations and root, rounded to nearest (`MachineArithmetic`),
// are the exact ones times 1 + d, |d| <= u = ε/2, unless they over- or underflow, which `in_range` (ccd/motion.hpp)
// excludes. The same holds for long double, x87's with 64 bits. Double-double has its own ε.
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
