// The exact errors at given inputs, for comparison with the rounding constants of oracle/.
#pragma once

#include "tests/proofs/numbers.hpp"
#include "tests/proofs/oracle_claim.hpp"

namespace nearmiss::proofs {

/// The relative error of a product of rounded leaves 1 - value, one for each input, in units of u.
double seen_leaves(const Inputs& inputs);
/// The contribution of the leaves' errors to their product, divided by the term that `cross_bound` has for
/// it.
double seen_growth(const Inputs& inputs);
/// The rounding error of t - h, in units of 2^-54.
double seen_end(const Inputs& inputs);
/// The rounding error of the beginning of a part within a part of the step, in units of 2^-52.
double seen_zoom(const Inputs& inputs);
/// The change of P on [t, t + h] from its value at t, divided by the bound in `error_near`, for exact b.
double seen_spread(const Inputs& inputs);
/// The amount by which a slope of exact coefficients exceeds that of computed ones, divided by the error.
double seen_slope(const Inputs& inputs);
double seen_upper_halves(const Inputs& inputs);
double seen_roundoff(const Inputs& inputs);
double seen_word_product(const Inputs& inputs);
double seen_word_sum(const Inputs& inputs);
/// The error beyond the relative error, in units of the smallest double.
double seen_word_underflow(const Inputs& inputs);

}  // namespace nearmiss::proofs
