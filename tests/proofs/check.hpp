// Whether a claim holds.
#pragma once

#include <string>
#include <vector>

#include "tests/proofs/claims.hpp"
#include "tests/proofs/oracle_claim.hpp"
#include "tests/proofs/witness.hpp"

namespace nearmiss::proofs {

/// The faults of a claim, in words; none if all of this holds: Gappa proves the proven error in every
/// precision, and in double with underflow; no result overflows; seen <= proven <= claimed; the witness has exactly
/// the error that is recorded with it.
std::vector<std::string> faults(const CcdClaim& claim, const Witness& witness, Prover& prover);

/// The same for all claims with the witnesses of a file, by two threads.
std::vector<std::string> faults(const std::vector<CcdClaim>& claims,
                                const std::map<std::string, Witness>& witnesses);

/// The faults of a claim about oracle/ likewise: seen <= proven <= claimed, and what the witness shows.
std::vector<std::string> faults(const OracleClaim& claim, const Witness& witness);

/// A row of the table: what is claimed, proven and seen of a constant, in its unit.
struct TableRow {
  std::string claim, constant, proof, unit;
  double claimed, proven, seen;
};

/// The rows of claims about ccd/, and of those about oracle/.
std::vector<TableRow> rows_of(const std::vector<CcdClaim>& claims,
                              const std::map<std::string, Witness>& witnesses);
std::vector<TableRow> rows_of(const std::vector<OracleClaim>& claims,
                              const std::map<std::string, Witness>& witnesses);

std::string table_of(const std::vector<TableRow>& rows);

}  // namespace nearmiss::proofs
