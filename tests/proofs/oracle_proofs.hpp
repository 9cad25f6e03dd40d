// The least value of each rounding constant of oracle/ that is proven to be enough, in its unit.
#pragma once

#include "tests/proofs/oracle_results.hpp"

namespace nearmiss::proofs {

using Results = std::vector<Bounded> (*)(Trace&, Leaves);

/// The factor that U w or U M needs: the roundings of all results over those of their bound, where leaves are
/// exact.
template <class Real>
double proven_rounding(Results results);
/// The factor that u w or u M needs if this many leaves are rounded once.
double proven_leaves(int leaves, Results results);
/// The factor that l and L need: one, over what roundings may take off these.
double proven_leaf_growth();
/// How often H must be added.
double proven_underflow_products();
/// The largest result of an operation, of a degree in components, over what the bound's w or M may be too
/// small by.
double proven_headroom(Results results, int degree);

/// For `error_near`: the factor that makes up for its roundings, how many errors a slope has, the rounding of an end
/// of the interval in units of 2^-54, and the lower halves of two double words over the larger upper half in units of
/// 2^-52.
double proven_spread_growth();
double proven_slope_errors();
double proven_end_rounding();
double proven_upper_halves();

/// How far the ends of a part of a part of the step are from where they should be, in units of 2^-52.
double proven_zoom_rounding();

/// The relative error of a rounding in units of 2^-53, and of a product of double words in units of 2^-103.
double proven_roundoff();
double proven_word_product();

}  // namespace nearmiss::proofs
