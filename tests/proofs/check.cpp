#include "tests/proofs/check.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <thread>

#include "reports/text/text.hpp"

namespace nearmiss::proofs {

namespace {

/// The largest result that is allowed for B = 1. Results have degree at most 4 in B <= 2^100 (claims.hpp), so
/// they are then finite.
constexpr double largest_allowed = 0x1p20;

/// The arithmetics for which a claim is proven.
std::vector<Arithmetic> arithmetics(const CcdClaim& claim) {
  std::vector<Arithmetic> all;
  for (const int bits : precisions) all.push_back({bits, {}, claim.vectors_alone});
  all.push_back({53, claim.underflow, claim.vectors_alone});
  return all;
}

}  // namespace

std::vector<std::string> faults(const CcdClaim& claim, const Witness& witness, Prover& prover) {
  std::vector<std::string> all;
  const auto fault = [&](const std::string& text) { all.push_back(fmt::format("{}: {}", claim.name, text)); };
  if (!(claim.proven <= claim.claimed))
    fault(fmt::format("{} is claimed, {} proven", claim.claimed, claim.proven));
  const auto error = Measure(claim).error(witness.inputs);
  if (!error)
    fault("the witness is not within bounds");
  else if (*error != witness.error)
    fault(fmt::format("the witness has an error of {:a}, not {:a}", *error, witness.error));
  if (!(witness.error <= claim.proven))
    fault(fmt::format("{} is seen, {} proven", witness.error, claim.proven));
  const Problem problem = claim.problem();
  for (const Arithmetic& arithmetic : arithmetics(claim))
    if (!prover.proves(problem, arithmetic, std::ldexp(claim.proven, 1 - arithmetic.bits)))
      fault(fmt::format("Gappa does not prove {} with {} bits{}", claim.proven, arithmetic.bits,
                        arithmetic.underflow ? " and underflow" : ""));
  if (!(prover.largest_result(problem, {53, {}, claim.vectors_alone}) <= largest_allowed))
    fault("Gappa does not prove that results are finite");
  return all;
}

std::vector<std::string> faults(const OracleClaim& claim, const Witness& witness) {
  std::vector<std::string> all;
  const auto fault = [&](const std::string& text) { all.push_back(fmt::format("{}: {}", claim.name, text)); };
  const double proven = claim.proven();
  if (!(proven <= claim.claimed)) fault(fmt::format("{} is claimed, {} proven", claim.claimed, proven));
  if (const double seen = claim.seen(witness.inputs); seen != witness.error)
    fault(fmt::format("the witness has an error of {:a}, not {:a}", seen, witness.error));
  if (!(0 < witness.error && witness.error <= proven))
    fault(fmt::format("{} is seen, {} proven", witness.error, proven));
  return all;
}

std::vector<std::string> faults(const std::vector<CcdClaim>& claims,
                                const std::map<std::string, Witness>& witnesses) {
  std::vector<std::string> all;
  std::mutex mutex;
  std::atomic<std::size_t> next = 0;
  Prover prover;
  const auto work = [&] {
    for (std::size_t i = next++; i < claims.size(); i = next++) {
      std::vector<std::string> found;
      try {
        found = faults(claims[i], witnesses.at(std::string(claims[i].name)), prover);
      } catch (const std::exception& error) {
        found = {fmt::format("{}: {}", claims[i].name, error.what())};
      }
      const std::lock_guard lock(mutex);
      all.insert(all.end(), found.begin(), found.end());
    }
  };
  std::thread other(work);
  work();
  other.join();
  return all;
}

namespace {

double seen(const std::map<std::string, Witness>& witnesses, std::string_view claim) {
  const auto witness = witnesses.find(std::string(claim));
  return witness == witnesses.end() ? std::nan("") : witness->second.error;
}

}  // namespace

std::vector<TableRow> rows_of(const std::vector<CcdClaim>& claims,
                              const std::map<std::string, Witness>& witnesses) {
  std::vector<TableRow> rows;
  for (const CcdClaim& claim : claims)
    rows.push_back({std::string(claim.name), std::string(claim.constant), std::string(claim.how),
                    std::string(claim.unit), claim.claimed, claim.proven, seen(witnesses, claim.name)});
  return rows;
}

std::vector<TableRow> rows_of(const std::vector<OracleClaim>& claims,
                              const std::map<std::string, Witness>& witnesses) {
  std::vector<TableRow> rows;
  for (const OracleClaim& claim : claims)
    rows.push_back({claim.name, claim.constant() + ", " + claim.file, claim.method, claim.unit, claim.claimed,
                    claim.proven(), seen(witnesses, claim.name)});
  return rows;
}

std::string table_of(const std::vector<TableRow>& rows) {
  std::vector<std::vector<std::string>> text{
      {"claim", "constant", "proof", "unit", "claimed", "proven", "seen"}};
  for (const TableRow& row : rows)
    text.push_back({row.claim, row.constant, row.proof, row.unit, fmt::format("{:.5g}", row.claimed),
                    fmt::format("{:.5g}", row.proven),
                    std::isnan(row.seen) ? "" : fmt::format("{:.3g}", row.seen)});
  return columns(text, 4);
}

}  // namespace nearmiss::proofs
