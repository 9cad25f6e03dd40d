// The ladder of precisions: how far false positives are for each machine epsilon.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// A subject's place on a ladder. For a subject that is not on a ladder, the algorithm is the subject itself.
struct LadderPlace {
  std::string algorithm;  ///< with options, and a bound that the user gave: "wang-eps:h=0.001@0.5"
  std::string scalar;
  int epsilon_exponent = 0;
  /// The bound by which the distances of false positives are divided, itself in units of B; nothing if it is
  /// not known.
  std::optional<double> unit;
};

LadderPlace place_of(const std::string& subject);

/// An object with "algorithm", "scalar" and "epsilon".
nlohmann::ordered_json place_json(const LadderPlace& place);

/// A subject of the ladder; distances in units of B.
struct Rung : LadderPlace {
  std::string subject;
  CountsSum sum;  ///< over all families and kinds

  /// The distance bound.
  [[nodiscard]] double claimed() const { return *unit; }
  /// Farthest distance divided by claimed distance; 0 without false positives.
  [[nodiscard]] double part() const { return sum.counts.max_ratio(); }
  /// Distance of the farthest false positive; 0 without false positives.
  [[nodiscard]] double farthest() const { return part() * claimed(); }
};

/// The rungs of wang and wang-tight over the scalars in the statistics, by ascending precision. Counts the
/// queries of one origin (family.hpp), or of all origins if `origin` is "".
std::vector<Rung> rungs(const Statistics& statistics, std::string_view origin = "");

/// The farthest distance of an algorithm as a power of ε: a line fitted to logarithms by least squares, for
/// the queries of one origin or of all.
struct Fit {
  std::string algorithm, origin;
  double exponent = 0, standard_error = 0;
  double half_width_95 = 0;                  ///< half the width of its 95 % confidence interval (Student's t)
  int points = 0;                            ///< number of subjects
  int precisions = 0;                        ///< number of different ε
  double least_part = 0, greatest_part = 0;  ///< range of Rung::part()

  /// Whether the farthest false positives almost reach the claimed distances. Then the fit only repeats the
  /// exponent in the formula of the claim.
  [[nodiscard]] bool restates_the_bound() const { return least_part > 0.9; }
};

/// Fits an algorithm's rungs with ε from 2^-127 to 2^-23. Rungs whose farthest false positive is below the
/// histogram's lowest border are left out. Nothing for fewer than three values of ε.
std::optional<Fit> fit(const std::vector<Rung>& rungs, const std::string& algorithm);

/// For each algorithm, the fit over all origins, and the fit for each single origin.
std::vector<Fit> fits(const Statistics& statistics);

/// Describes a fit in one line of text.
std::string describe(const Fit& line);

/// An object with "rungs" and "fits"; nothing unless an algorithm has at least two precisions.
std::optional<nlohmann::ordered_json> ladder_json(const Statistics& statistics);

/// A row for each rung, and the fits over all origins; "" unless an algorithm has at least two precisions.
std::string ladder_table(const Statistics& statistics);

}  // namespace nearmiss
