#include "tests/proofs/oracle_witness.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace nearmiss::proofs {

namespace {

/// The inputs with one of them changed.
Inputs changed(Inputs inputs, const OracleClaim& claim, Random& random) {
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

Witness find_witness(const OracleClaim& claim, Random& random, int steps) {
  Witness best;
  Witness here;
  const int climb = std::max(100, steps / 8);
  for (int i = 0; i < steps; ++i) {
    const bool begins = i % climb < climb / 10 || here.inputs.empty();
    if (i % climb == 0) here = {-1, {}};
    const Inputs next = begins ? claim.draw(random) : changed(here.inputs, claim, random);
    if (!are_double_words(next)) continue;
    const double seen = claim.seen(next);
    if (seen < here.error) continue;
    here = {seen, next};
    if (seen > best.error || best.inputs.empty()) best = here;
  }
  return best;
}

}  // namespace nearmiss::proofs
