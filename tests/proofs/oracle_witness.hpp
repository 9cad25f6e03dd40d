// The search for witnesses of oracle/'s bounds.
#pragma once

#include "tests/proofs/oracle_claim.hpp"

namespace nearmiss::proofs {

/// The best inputs that a hill climb of `steps` steps finds: it restarts now and then, and changes one input at
/// a time, by little or altogether.
Witness find_witness(const OracleClaim& claim, Random& random, int steps);

}  // namespace nearmiss::proofs
