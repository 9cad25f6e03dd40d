// A subject's place on the ladder of precisions (sections.hpp).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace nearmiss {

/// A subject's place on a ladder. For a subject that is not on a ladder, the algorithm is the subject itself.
struct LadderPlace {
  std::string algorithm;  ///< with options, and a bound that the user gave: "wang-eps:h=0.001@0.5"
  std::string scalar;
  int epsilon_exponent = 0;
  /// The bound by which the distances of false positives are divided. The bound is in units of B; nothing if
  /// it is not known.
  std::optional<double> unit;
};

LadderPlace place_of(const std::string& subject);

/// An object with "algorithm", "scalar" and "epsilon".
nlohmann::ordered_json place_json(const LadderPlace& place);

}  // namespace nearmiss
