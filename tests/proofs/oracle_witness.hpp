// The search for witnesses of oracle/'s bounds.
#pragma once

#include "tests/proofs/oracle_claim.hpp"

namespace nearmiss::proofs {

/// The best inputs that a hill climb of `steps` steps finds. It restarts now and then, and changes one input
/// at a time, by a small amount or to a new value.
Witness find_witness(const OracleClaim& claim, Random& random, int steps);

}  // namespace nearmiss::proofs
