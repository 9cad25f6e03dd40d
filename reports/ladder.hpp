// The ladder of precisions: how far false positives are for each machine epsilon.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/statistics.hpp"

namespace nearmiss {

/// A subject of the ladder; distances in units of B.
struct Rung {
  std::string subject, algorithm, scalar;
  int epsilon_exponent = 0;
  double claimed = 0;   ///< the distance bound
  double farthest = 0;  ///< of its false positives; 0 where there is none
  Counts counts;        ///< over all families and kinds
};

/// A subject's place on a ladder. One that is on none is an algorithm of its own.
struct LadderPlace {
  std::string algorithm, scalar;  ///< the algorithm with its bound, if one is given: "wang@0.5"
  int epsilon_exponent = 0;
  /// What the distances of its false positives are fractions of, in units of B; nothing where not known.
  std::optional<double> unit;
};

LadderPlace place_of(const std::string& subject);

/// wang and wang-tight over the scalars that statistics have, by ascending precision; of one origin
/// (family.hpp), or of all where it is "".
std::vector<Rung> rungs(const Statistics& statistics, std::string_view origin = "");

/// The power of ε by which the farthest distance of an algorithm falls, fitted by least squares to its
/// logarithm, for one origin or for all.
struct Fit {
  std::string algorithm, origin;
  double exponent = 0, standard_error = 0;
  double half_width_95 = 0;                  ///< of the exponent's 95 % confidence interval (Student's t)
  int points = 0;                            ///< subjects
  int precisions = 0;                        ///< how many ε they have
  double least_part = 0, greatest_part = 0;  ///< of farthest / claimed

  /// Whether the claimed distances are all but reached, so that the exponent is that of their formula.
  [[nodiscard]] bool restates_the_bound() const { return least_part > 0.9; }
};

/// Over the rungs of an algorithm with ε from 2^-127 to 2^-23 that have a false positive, and not all nearer than the
/// histogram's lowest border; nothing for fewer than three ε.
std::optional<Fit> fit(const std::vector<Rung>& rungs, const std::string& algorithm);

/// For each algorithm that over all, and those over each origin.
std::vector<Fit> fits(const Statistics& statistics);

/// A fit in a line, for people.
std::string describe(const Fit& line);

/// "rungs" and "fits"; nothing where fewer than two precisions of an algorithm are there.
std::optional<nlohmann::ordered_json> ladder_json(const Statistics& statistics);

/// A row for each rung, and the fits over all; "" likewise.
std::string ladder_table(const Statistics& statistics);

}  // namespace nearmiss
