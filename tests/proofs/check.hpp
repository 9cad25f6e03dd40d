// Checks claims.
#pragma once

#include <string>
#include <vector>

#include "tests/proofs/claims.hpp"
#include "tests/proofs/oracle_claim.hpp"
#include "tests/proofs/witness.hpp"

namespace nearmiss::proofs {

/// Describes the faults of a claim. A claim has none if Gappa proves the bound `proven` in every precision,
/// and in double also with underflow; no result overflows; seen <= proven <= claimed; and the witness has
/// exactly the recorded error.
std::vector<std::string> faults(const CcdClaim& claim, const Witness& witness, Prover& prover);

/// The faults of all claims with the witnesses of a file. Uses two threads.
std::vector<std::string> faults(const std::vector<CcdClaim>& claims,
                                const std::map<std::string, Witness>& witnesses);

/// Describes the faults of a claim about oracle/: whether seen <= proven <= claimed fails, or the witness
/// does not have the recorded error.
std::vector<std::string> faults(const OracleClaim& claim, const Witness& witness);

/// A row of the table: the claimed, the proven and the seen value of a constant, in its unit.
struct TableRow {
  std::string claim, constant, proof, unit;
  double claimed, proven, seen;
};

/// The rows of claims about ccd/, or about oracle/.
std::vector<TableRow> rows_of(const std::vector<CcdClaim>& claims,
                              const std::map<std::string, Witness>& witnesses);
std::vector<TableRow> rows_of(const std::vector<OracleClaim>& claims,
                              const std::map<std::string, Witness>& witnesses);

std::string table_of(const std::vector<TableRow>& rows);

}  // namespace nearmiss::proofs
