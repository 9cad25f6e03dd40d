// Inputs with large rounding errors, which show how tight a bound is.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace nearmiss::proofs {

/// Values of a problem's inputs, and of numbers that the problem takes as given, by name.
using Inputs = std::map<std::string, double>;

/// The inputs with the largest known error of a claim, and this error in the claim's unit.
struct Witness {
  double error = 0;
  Inputs inputs;
};
using Witnesses = std::map<std::string, Witness>;

/// Reads witnesses by claim. A line of the file is "claim = error : name=value ...", with hexadecimal
/// numbers.
Witnesses read_witnesses(const std::filesystem::path& file);
void write_witnesses(const std::filesystem::path& file, const Witnesses& witnesses);

}  // namespace nearmiss::proofs
