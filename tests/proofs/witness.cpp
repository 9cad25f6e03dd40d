#include "tests/proofs/witness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace nearmiss::proofs {

namespace {

double parse(const std::string& text, const std::string& line) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0')
    throw std::runtime_error("found '" + text + "', expected a number: " + line);
  return value;
}

/// One input changed.
Inputs changed(Inputs inputs, const Claim& claim, Random& random) {
  const auto name = std::next(inputs.begin(), random.integer(0, static_cast<int>(inputs.size()) - 1));
  double& value = name->second;
  switch (random.integer(0, 3)) {
    case 0:
      value = claim.draw(random)[name->first];
      break;
    case 1:
      value *= 1 + std::ldexp(random.uniform(-1, 1), -random.integer(0, 50));
      break;
    case 2:
      for (int i = random.integer(1, 4); i > 0; --i)
        value = std::nextafter(value, random.one_in(2) ? 1e300 : -1e300);
      break;
    default:
      value = std::ldexp(std::round(std::ldexp(value, 8)), -8);  // few bits
  }
  return inputs;
}

/// Whether lower halves of double words are within half an ulp of the upper ones.
bool are_double_words(const Inputs& inputs) {
  return std::all_of(inputs.begin(), inputs.end(), [&](const auto& input) {
    const auto& [name, value] = input;
    if (!name.ends_with(".lo")) return true;
    const double upper = inputs.at(name.substr(0, name.size() - 3));
    return upper + value == upper;
  });
}

}  // namespace

std::map<std::string, Witness> read_witnesses(const std::filesystem::path& file) {
  std::map<std::string, Witness> witnesses;
  std::ifstream in(file);
  if (!in) throw std::runtime_error("found no file " + file.string());
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.front() == '#') continue;
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) throw std::runtime_error("found no ':' in " + line);
    Witness& witness = witnesses[line.substr(0, colon)];
    std::istringstream words(line.substr(colon + 1));
    std::string word;
    words >> word;
    witness.seen = parse(word, line);
    while (words >> word) {
      const std::size_t equals = word.find('=');
      if (equals == std::string::npos) throw std::runtime_error("found no '=' in " + word + ": " + line);
      witness.inputs[word.substr(0, equals)] = parse(word.substr(equals + 1), line);
    }
  }
  return witnesses;
}

void write_witnesses(const std::filesystem::path& file, const std::map<std::string, Witness>& witnesses) {
  std::ofstream out(file);
  out << "# Inputs that come nearest to the bound of each constant: its name, the error, the inputs.\n";
  for (const auto& [name, witness] : witnesses) {
    out << fmt::format("{}: {:a}", name, witness.seen);
    for (const auto& [input, value] : witness.inputs) out << fmt::format(" {}={:a}", input, value);
    out << '\n';
  }
  if (!out.flush()) throw std::runtime_error("found no room for " + file.string());
}

Witness find_witness(const Claim& claim, Random& random, int steps) {
  Witness best;
  Witness here;
  const int climb = std::max(100, steps / 8);
  for (int i = 0; i < steps; ++i) {
    const bool begins = i % climb < climb / 10 || here.inputs.empty();
    if (i % climb == 0) here = {-1, {}};
    const Inputs next = begins ? claim.draw(random) : changed(here.inputs, claim, random);
    if (!are_double_words(next)) continue;
    const double seen = claim.seen(next);
    if (seen < here.seen) continue;
    here = {seen, next};
    if (seen > best.seen || best.inputs.empty()) best = here;
  }
  return best;
}

}  // namespace nearmiss::proofs
