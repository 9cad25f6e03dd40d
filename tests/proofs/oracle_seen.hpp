// The errors that inputs show, exactly, for comparison with the rounding constants of oracle/.
#pragma once

#include "tests/proofs/numbers.hpp"
#include "tests/proofs/oracle_claim.hpp"

namespace nearmiss::proofs {

/// The relative error of a product of leaves that are 1, each the rounded value of what an input says, in units of u.
double seen_leaves(const Inputs& inputs);
/// The errors' contribution to a product of leaves, over the term that `cross_bound` has for it.
double seen_growth(const Inputs& inputs);
/// The rounding of t - h, over 2^-54.
double seen_end(const Inputs& inputs);
/// The same of the beginning of a part of a part, over 2^-52.
double seen_zoom(const Inputs& inputs);
/// How far P is from its value at t on [t, t + h], by what `error_near` has for it, where b is exact.
double seen_spread(const Inputs& inputs);
/// By how much a slope of exact coefficients may exceed that of computed ones, over the error.
double seen_slope(const Inputs& inputs);
double seen_upper_halves(const Inputs& inputs);
double seen_roundoff(const Inputs& inputs);
double seen_word_product(const Inputs& inputs);
double seen_word_sum(const Inputs& inputs);
/// Beyond the relative error, in units of the smallest double.
double seen_word_underflow(const Inputs& inputs);

}  // namespace nearmiss::proofs
