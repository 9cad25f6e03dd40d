// Scalars of the machine, and two doubles.
#include "fuzz/ladder/double_double.hpp"
#include "fuzz/ladder/scaled_subject.hpp"

#if __has_include(<quadmath.h>)
#include <boost/multiprecision/float128.hpp>
#endif

namespace nearmiss::ladder {

namespace {

template <class T>
constexpr Scalar scalar(std::string_view name) {
  return {name, epsilon_exponent<T>, &make_scaled<T>};
}

constexpr std::array all{
    scalar<float>("float"),
    scalar<double>("double"),
    scalar<long double>("longdouble"),
    scalar<DoubleDouble>("dd"),
};

}  // namespace

std::span<const Scalar> machine_scalars() { return all; }

}  // namespace nearmiss::ladder
