// Scalars of the machine, and two doubles.
#include "fuzz/ladder/double_double.hpp"
#include "fuzz/ladder/scaled_subject.hpp"

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
