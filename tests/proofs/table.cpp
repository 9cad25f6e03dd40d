// proofs_table: the table of bounds as text. With --search STEPS looks for better witnesses and keeps them.
#include <fmt/format.h>

#include <cstdlib>
#include <cstring>

#include "tests/proofs/claim.hpp"
#include "tests/proofs/witness.hpp"

namespace {

using namespace nearmiss;
using namespace nearmiss::proofs;

const std::string file = NEARMISS_WITNESSES "/oracle.txt";

std::map<std::string, Witness> known() {
  return std::filesystem::exists(file) ? read_witnesses(file) : std::map<std::string, Witness>();
}

void search(int steps, std::uint64_t seed) {
  auto witnesses = known();
  std::uint64_t stream = 0;
  for (const Claim& claim : oracle_claims()) {
    Random random(seed, stream++, 0);
    const Witness found = find_witness(claim, random, steps);
    Witness& best = witnesses[claim.name];
    if (best.inputs.empty() || claim.seen(best.inputs) < found.seen) best = found;
    best.seen = claim.seen(best.inputs);
    fmt::print("{:45} {:.6g}\n", claim.name, best.seen);
  }
  write_witnesses(file, witnesses);
}

void print() {
  const auto witnesses = known();
  fmt::print("{:38} {:20} {:14} {:>8} {:>10} {:>10}  {}\n", "constant", "file", "unit", "claimed", "proven",
             "seen", "by");
  for (const Claim& claim : oracle_claims()) {
    const auto witness = witnesses.find(claim.name);
    fmt::print("{:38} {:20} {:14} {:8.6g} {:10.6g} {:10.6g}  {}\n", claim.name, claim.file, claim.unit,
               claim.claimed, claim.proven(), witness == witnesses.end() ? NAN : witness->second.seen,
               claim.method);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 1) {
    print();
    return 0;
  }
  if (argc >= 3 && std::strcmp(argv[1], "--search") == 0) {
    search(std::atoi(argv[2]), argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1);
    return 0;
  }
  fmt::print(stderr, "usage: proofs_table [--search STEPS [SEED]]\n");
  return 2;
}
