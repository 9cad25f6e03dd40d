#include "tests/proofs/claims.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <thread>

#include "reports/text/text.hpp"
#include "tests/proofs/measure.hpp"

namespace nearmiss::proofs {

namespace {

/// The largest result that a claim may have for B = 1. Since results have degree at most 4 in B, and B <=
/// 2^100 (claims.hpp), results within this limit are finite.
constexpr double largest_allowed = 0x1p20;

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
  for (const int bits : precisions)
    if (!prover.proves(problem, {bits, {}, claim.vectors_alone}, std::ldexp(claim.proven, 1 - bits)))
      fault(fmt::format("Gappa does not prove {} with {} bits", claim.proven, bits));
  const ProvenBounds bounds = prover.bounds(problem, {53, claim.underflow, claim.vectors_alone});
  const double best = std::ldexp(bounds.error, 52);
  if (!(best <= claim.proven)) fault(fmt::format("Gappa proves only {} with underflow", best));
  if (!(claim.proven <= 1.1 * best)) fault(fmt::format("Gappa proves {}, far below {}", best, claim.proven));
  // If a script left out a part of its formula, Gappa could prove a bound below an error that was seen.
  if (!(witness.error <= best)) fault(fmt::format("{} is seen, but Gappa proves {}", witness.error, best));
  if (!(bounds.largest_result <= largest_allowed)) fault("Gappa does not prove that results are finite");
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

std::vector<std::string> faults(const std::vector<CcdClaim>& claims, const Witnesses& witnesses) {
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

std::string table_of_bounds(const Witnesses& witnesses) {
  std::vector<std::vector<std::string>> rows{
      {"claim", "constant", "proof", "unit", "claimed", "proven", "seen"}};
  const auto add = [&](const auto& claim, const std::string& constant, std::string_view how, double proven) {
    const auto witness = witnesses.find(std::string(claim.name));
    rows.push_back({std::string(claim.name), constant, std::string(how), std::string(claim.unit),
                    fmt::format("{:.5g}", claim.claimed), fmt::format("{:.5g}", proven),
                    witness == witnesses.end() ? "" : fmt::format("{:.3g}", witness->second.error)});
  };
  for (const OracleClaim& claim : oracle_claims())
    add(claim, claim.constant() + ", " + claim.file, claim.method, claim.proven());
  for (const CcdClaim& claim : ccd_claims()) add(claim, std::string(claim.constant), claim.how, claim.proven);
  return columns(rows, 4);
}

}  // namespace nearmiss::proofs
