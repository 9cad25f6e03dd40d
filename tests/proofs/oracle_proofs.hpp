// For each rounding constant of oracle/, the least value that is proven to be enough, in its unit.
#pragma once

#include "tests/proofs/oracle_results.hpp"

namespace nearmiss::proofs {

/// For exact leaves: the factor of U w or U M that the bound needs to cover the rounding errors of all
/// results.
template <class Real>
double proven_rounding(Results results);
/// The factor of u w or u M that is required if this many leaves are rounded once.
double proven_leaves(int leaves, Results results);
/// The factor of l and L that compensates for the roundings of their bound.
double proven_leaf_growth();
/// How many times H must be added to a bound to cover underflow.
double proven_underflow_products();
/// The largest result of an operation, of this degree in components, relative to the bound's w or M, which
/// may be rounded down.
double proven_headroom(Results results, int degree);

/// Constants of `error_near`: the factor that compensates for its roundings; the number of errors in a slope;
/// the rounding of an end of the interval in units of 2^-54; and the lower halves of two double words,
/// divided by the larger upper half, in units of 2^-52.
double proven_spread_growth();
double proven_slope_errors();
double proven_end_rounding();
double proven_upper_halves();

/// Constants of `derivative`: the roundings of a slope, in units of U times the largest coefficient, and
/// the number of errors in it.
double proven_slope_rounding();
double proven_slope_growth();

/// Constant of `neighbours_of_root`: the roundings of a value beside t, in units of U (|v| + |S| g).
double proven_secant_rounding();

/// The error of the ends of a part within a part of the step, in units of 2^-52.
double proven_zoom_rounding();

/// The relative errors of a rounding in units of 2^-53, and of a product of double words in units of 2^-103.
double proven_roundoff();
double proven_word_product();

}  // namespace nearmiss::proofs
