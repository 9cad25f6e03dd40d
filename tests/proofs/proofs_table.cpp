// proofs_table: prints the table of claims about rounding errors, and searches for new witnesses.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>

#include "tests/proofs/claims.hpp"
#include "tests/proofs/measure.hpp"

using namespace nearmiss::proofs;

namespace {

/// For each claim, searches for inputs with a larger error than that of the claim's known witness. If the
/// search finds such inputs, keeps them as the new witness.
template <class Claim>
void search_all(const std::vector<Claim>& claims, Witnesses& witnesses, const ClimbEffort& effort) {
  for (const Claim& claim : claims) {
    Witness& known = witnesses[std::string(claim.name)];
    const Witness found = find_witness(claim, known.inputs, effort);
    if (found.error > known.error) known = found;
    fmt::print(stderr, "{}: {:.4g}\n", claim.name, known.error);
  }
}

struct Options {
  int steps = 0;
  std::uint64_t seed = 0;
  std::string name;
};

void add_options(CLI::App& app, Options& options) {
  app.add_option("--search", options.steps,
                 "Search for larger errors in this many steps per row, and keep them");
  app.add_option("--seed", options.seed, "Seed of the search");
  app.add_option("--script", options.name, "Print the last Gappa script of this row of ccd/, for double");
}

void print_script(std::string_view name) {
  for (const CcdClaim& claim : ccd_claims())
    if (claim.name == name)
      fmt::print("{}",
                 Prover().script(claim.problem(), {53, {}, claim.vectors_alone}, claim.proven * 0x1p-52));
}

void run(const Options& options) {
  if (!options.name.empty()) return print_script(options.name);
  Witnesses witnesses = read_witnesses(NEARMISS_WITNESSES);
  if (options.steps > 0) {
    const ClimbEffort effort{.rounds = 8, .steps = options.steps / 10, .seed = options.seed};
    search_all(ccd_claims(), witnesses, effort);
    search_all(oracle_claims(), witnesses, effort);
    write_witnesses(NEARMISS_WITNESSES, witnesses);
  }
  fmt::print("{}", table_of_bounds(witnesses));
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
