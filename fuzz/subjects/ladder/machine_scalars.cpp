// Scalars of the machine, and double-double. The operations and the square root of IEEE 754, rounded to
// nearest (`MachineArithmetic`), give the exact result times 1 + d with |d| <= u = ε/2, unless they overflow
// or underflow, which `in_range` (ccd/wang/motion.hpp) excludes. The same holds for long double, the x87 type with
// 64 bits. Double-double has its own ε.
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
