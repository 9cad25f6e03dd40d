// For each rounding constant of oracle/, the least value that is proven to be enough, in the unit of the
// constant. The letters are those of oracle/filter/step_part.hpp. U is the largest relative error of an
// operation; for operations in double, it is called u. w and M are sums of the magnitudes of products: w for
// a weight, and M for F, the coplanarity cubic. l and L bound those parts of the errors of a weight and of F
// that come from the errors of the vectors. H is the largest error of a product by underflow.
#pragma once

#include "tests/proofs/oracle_results.hpp"

namespace nearmiss::proofs {

/// The factor by which U w (for weights) or U M (for F) must be multiplied to cover the rounding errors of
/// all results, if the components of the vectors are exact.
template <class Real>
double proven_rounding(Results results);
/// The factor by which u w or u M must be multiplied to cover the errors of products of `leaves` components,
/// each of which has been rounded once.
double proven_leaves(int leaves, Results results);
/// The factor by which l and L must be multiplied in a bound, to compensate for the roundings of the bound.
double proven_leaf_growth();
/// How many times H must be added to a bound to cover underflow.
double proven_underflow_products();
/// The largest magnitude of the intermediate results that have the given degree in the components, divided by
/// the computed w or M. The computed w or M may have been rounded down.
double proven_headroom(Results results, int degree);

/// The factor that compensates for the roundings in `error_near`.
double proven_spread_growth();
/// How many times the error of a coefficient enters a slope in `error_near`.
double proven_slope_errors();
/// The rounding error of t - h or t + h, an end of the interval of `error_near`, in units of 2^-54.
double proven_end_rounding();
/// The difference of the lower halves of two double words, divided by the larger upper half, in units of
/// 2^-52.
double proven_upper_halves();

/// The rounding error of a value of `derivative`, in units of U times the largest coefficient of the cubic.
double proven_slope_rounding();
/// How many times the error of a coefficient enters a value of `derivative`.
double proven_slope_growth();

/// The rounding error of v + S g in `neighbours_of_root`, in units of U (|v| + |S| g). v + S g is the value
/// of F at a distance g from t, computed from its value v and slope S at t.
double proven_secant_rounding();

/// The rounding error of b + x (e - b), a time in the part [b, e] of the step, in units of 2^-52.
double proven_zoom_rounding();

/// The relative error of a rounding, in units of 2^-53.
double proven_roundoff();
/// The relative error of a product of double words, in units of 2^-103.
double proven_word_product();

}  // namespace nearmiss::proofs
