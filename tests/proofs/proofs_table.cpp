// proofs_table: prints the table of claims about rounding errors, and searches for new witnesses.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <optional>

#include "tests/proofs/check.hpp"
#include "tests/proofs/oracle_witness.hpp"

using namespace nearmiss::proofs;

namespace {

/// The known witness with the largest error of a claim: its own, or that of another claim with the same
/// inputs.
std::optional<Witness> best_known(const CcdClaim& claim, const std::map<std::string, Witness>& witnesses) {
  const Measure measure(claim);
  std::optional<Witness> best;
  for (const auto& [name, witness] : witnesses) {
    if (!measure.has_inputs(witness.inputs)) continue;
    const auto error = measure.error(witness.inputs);
    if (error && (!best || *error > best->error)) best = {*error, witness.inputs};
  }
  return best;
}

/// Searches for a larger error of each claim, starting at the known witnesses.
void search_all(const std::vector<CcdClaim>& claims, std::map<std::string, Witness>& witnesses,
                double seconds, std::uint64_t seed) {
  for (const CcdClaim& claim : claims) {
    const Witness found = search(claim, best_known(claim, witnesses), seconds, seed);
    fmt::print(stderr, "{}: {:.4g}\n", claim.name, found.error);
    witnesses[std::string(claim.name)] = found;
  }
}

/// Searches for a larger error of each claim of oracle/, with a number of steps instead of a time.
void search_all(const std::vector<OracleClaim>& claims, std::map<std::string, Witness>& witnesses, int steps,
                std::uint64_t seed) {
  std::uint64_t stream = 0;
  for (const OracleClaim& claim : claims) {
    nearmiss::Random random(seed, stream++, 0);
    const Witness found = find_witness(claim, random, steps);
    Witness& known = witnesses[claim.name];
    const bool holds = !known.inputs.empty() && claim.seen(known.inputs) == known.error;
    if (!holds || known.error < found.error) known = found;
    fmt::print(stderr, "{}: {:.4g}\n", claim.name, known.error);
  }
}

/// Prints one line for each row, separated by tabs: whether it holds, its name, its constant, and its faults.
void check_all(const std::map<std::string, Witness>& witnesses,
               const std::map<std::string, Witness>& oracle_witnesses) {
  const auto show = [](std::string_view name, std::string_view constant,
                       const std::vector<std::string>& wrong) {
    fmt::print("{}\t{}\t{}\t{}\n", wrong.empty() ? "ok" : "FAULT", name, constant, fmt::join(wrong, "; "));
  };
  for (const OracleClaim& claim : oracle_claims())
    show(claim.name, claim.constant() + ", " + claim.file, faults(claim, oracle_witnesses.at(claim.name)));
  Prover prover;
  for (const CcdClaim& claim : ccd_claims())
    show(claim.name, claim.constant, faults(claim, witnesses.at(std::string(claim.name)), prover));
}

/// The witnesses in a file; none if the file does not exist yet.
std::map<std::string, Witness> known_witnesses(const std::string& file) {
  if (!std::filesystem::exists(file)) return {};
  return read_witnesses(file);
}

/// The options of the command line.
struct Options {
  double seconds = 0;
  int steps = 0;
  std::uint64_t seed = 0;
  std::string name;
  bool check = false;
};

void add_options(CLI::App& app, Options& options) {
  app.add_option("--search", options.seconds,
                 "Search for larger errors in ccd/ for this many seconds per row, and keep them");
  app.add_option("--search-oracle", options.steps,
                 "Search for larger errors in oracle/ in this many steps per row, and keep them");
  app.add_option("--seed", options.seed, "Seed of the search");
  app.add_option("--script", options.name, "Print the last Gappa script of this row, for double");
  app.add_flag("--check", options.check, "Print for every row whether it holds, and what is wrong");
}

void print_script(std::string_view name) {
  for (const CcdClaim& claim : ccd_claims())
    if (claim.name == name)
      fmt::print("{}",
                 Prover().script(claim.problem(), {53, {}, claim.vectors_alone}, claim.proven * 0x1p-52));
}

void run(const Options& options) {
  const std::string file = NEARMISS_WITNESSES "/ccd.txt";
  const std::string oracle_file = NEARMISS_WITNESSES "/oracle.txt";
  if (!options.name.empty()) return print_script(options.name);
  auto witnesses = known_witnesses(file);
  auto oracle_witnesses = known_witnesses(oracle_file);
  if (options.check) return check_all(witnesses, oracle_witnesses);
  if (options.seconds > 0) {
    search_all(ccd_claims(), witnesses, options.seconds, options.seed);
    write_witnesses(file, witnesses);
  }
  if (options.steps > 0) {
    search_all(oracle_claims(), oracle_witnesses, options.steps, options.seed);
    write_witnesses(oracle_file, oracle_witnesses);
  }
  auto rows = rows_of(oracle_claims(), oracle_witnesses);
  const auto of_ccd = rows_of(ccd_claims(), witnesses);
  rows.insert(rows.end(), of_ccd.begin(), of_ccd.end());
  fmt::print("{}", table_of(rows));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Print the table of claims about rounding errors: the claimed, the proven and the seen values");
  Options options;
  add_options(app, options);
  CLI11_PARSE(app, argc, argv);
  try {
    run(options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
  return 0;
}
