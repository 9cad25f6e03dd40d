#include "tests/proofs/witness.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace nearmiss::proofs {

Witnesses read_witnesses(const std::filesystem::path& file) {
  Witnesses all;
  std::ifstream lines(file);
  if (!lines) throw std::runtime_error(file.string() + " cannot be read");
  for (std::string line; std::getline(lines, line);) {
    const auto equals = line.find(" = ");
    const auto colon = line.find(" : ");
    if (equals == std::string::npos || colon == std::string::npos)
      throw std::runtime_error(file.string() + ": not a witness: " + line);
    Witness& witness = all[line.substr(0, equals)];
    witness.error = std::strtod(line.c_str() + equals + 3, nullptr);
    std::istringstream inputs(line.substr(colon + 3));
    for (std::string input; inputs >> input;) {
      const auto sign = input.find('=');
      witness.inputs[input.substr(0, sign)] = std::strtod(input.c_str() + sign + 1, nullptr);
    }
  }
  return all;
}

void write_witnesses(const std::filesystem::path& file, const Witnesses& witnesses) {
  std::ofstream lines(file);
  for (const auto& [claim, witness] : witnesses) {
    lines << fmt::format("{} = {:a} :", claim, witness.error);
    for (const auto& [name, value] : witness.inputs) lines << fmt::format(" {}={:a}", name, value);
    lines << '\n';
  }
  if (!lines.flush()) throw std::runtime_error(file.string() + " cannot be written");
}

}  // namespace nearmiss::proofs
