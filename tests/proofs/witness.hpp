// Witnesses: inputs that show how near an error comes to a bound, kept as text.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "tests/proofs/claim.hpp"

namespace nearmiss::proofs {

/// Inputs, and the error that they show.
struct Witness {
  double seen = 0;
  Inputs inputs;
};

/// By the claim's name. A line of the file is the name, ':', the error, and NAME=VALUE for each input, all numbers
/// as hex floats; '#' starts a comment. Throws std::runtime_error for a line that is not like that.
std::map<std::string, Witness> read_witnesses(const std::filesystem::path& file);
void write_witnesses(const std::filesystem::path& file, const std::map<std::string, Witness>& witnesses);

/// The best inputs that a hill climb of so many steps finds: it begins anew now and then, and changes one input at
/// a time, by little or altogether.
Witness find_witness(const Claim& claim, Random& random, int steps);

}  // namespace nearmiss::proofs
