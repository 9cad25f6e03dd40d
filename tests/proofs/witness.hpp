// Inputs with large rounding errors: how near to a bound one comes.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/random.hpp"
#include "tests/proofs/claims.hpp"
#include "tests/proofs/numbers.hpp"
#include "tests/proofs/program.hpp"

namespace nearmiss::proofs {

/// Values of a problem's inputs, and of numbers that it takes as given, by name.
using Inputs = std::map<std::string, double>;

/// The inputs with the largest error that is known of a claim, and that error in the claim's unit.
struct Witness {
  double error = 0;
  Inputs inputs;
};

/// Witnesses by claim. A line of a file is "claim = error : name=value ...", numbers in hexadecimal.
std::map<std::string, Witness> read_witnesses(const std::filesystem::path& file);
void write_witnesses(const std::filesystem::path& file, const std::map<std::string, Witness>& witnesses);

/// Measures errors of a problem in double, B being the smallest for which the inputs are within bounds.
class Measure {
 public:
  explicit Measure(const CcdClaim& claim);

  /// The error in the claim's unit, truncated to double from the exact one; nothing where inputs are out of
  /// bounds for every B.
  [[nodiscard]] std::optional<double> error(const Inputs& inputs) const { return measured<Rational>(inputs); }
  /// About the same, and quickly.
  [[nodiscard]] std::optional<double> estimate(const Inputs& inputs) const {
    return measured<long double>(inputs);
  }

  /// Whether these are the names of all inputs.
  [[nodiscard]] bool has_inputs(const Inputs& inputs) const;

  /// Inputs that are within bounds, hopefully.
  [[nodiscard]] Inputs drawn(Random& random) const;
  [[nodiscard]] Inputs changed(Random& random, const Inputs& inputs) const;

 private:
  struct Limit {
    int index;
    double lowest, highest;
    int degree;
  };

  void limit(const Traced& expression, double lowest, double highest, int degree);
  [[nodiscard]] double draw(Random& random, const std::string& name) const;
  void choose_bound(Inputs& inputs) const;
  template <class Number>
  [[nodiscard]] std::optional<double> measured(const Inputs& inputs) const;
  template <class Number>
  [[nodiscard]] std::vector<Number> results(const Inputs& inputs) const;
  template <class Number>
  [[nodiscard]] Number smallest_bound(const std::vector<Number>& exact) const;

  Program program_;
  int left_, right_, degree_;
  bool vectors_alone_;
  std::vector<int> vectors_;          ///< components of the motions
  std::map<int, std::string> given_;  ///< what is not an input, and yet exact
  std::vector<Limit> limits_;
  std::vector<std::string> names_;
};

/// Climbs from random inputs, and from `start` where there is one, to large errors for a time in seconds.
Witness search(const CcdClaim& claim, const std::optional<Witness>& start, double seconds,
               std::uint64_t seed);

}  // namespace nearmiss::proofs
