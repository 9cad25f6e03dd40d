// Sweeps: a subject's counters along one parameter of a family, or along the values of one of its options.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "reports/statistics/confidence.hpp"
#include "reports/statistics/family_class.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// Sums of counters over all kinds, by the value of the parameter.
using Sweep = std::map<double, CountsSum>;

/// The sweeps in a campaign by family, NAME or NAME~SEPARATION, and by subject: families NAME@VALUE and
/// NAME@VALUE~SEPARATION with at least two values.
std::map<std::pair<std::string, std::string>, Sweep> sweeps(const Statistics& statistics);

/// Sums of counters over all kinds, by class of families and value of the option.
using OptionSweep = std::map<std::pair<QueryClass, double>, CountsSum>;

/// The sweeps of options in a campaign by pattern: subjects NAME:KEY=NUMBER with at least two different
/// numbers have the pattern NAME:KEY=*.
std::map<std::string, OptionSweep> option_sweeps(const Statistics& statistics);

/// Two neighbouring values of an option, and the misses among the collisions with each of them.
struct Cliff {
  std::string pattern;
  QueryClass of{};  ///< of the families
  double value = 0, next = 0;
  Proportion missed, missed_next;
};

/// For each sweep of an option, the neighbouring values between which the rate of misses changes most, in the
/// least exotic class in which a rate changes by more than chance explains (p < 0.001). Sweeps without such
/// a change are left out.
std::vector<Cliff> cliffs(const Statistics& statistics);

/// An object for each cliff; empty without cliffs.
nlohmann::ordered_json cliffs_json(const Statistics& statistics);

/// A table for each sweep and subject with a row for each value, then one for each sweep of an option with a
/// row for each class and value, and its cliff; "" without sweeps.
std::string sweep_tables(const Statistics& statistics);

/// An object by family, then by subject: a list with an entry for each value of the family's parameter, in
/// increasing order. Empty without sweeps.
nlohmann::ordered_json sweeps_json(const Statistics& statistics);

/// An object with a list for each pattern, in the order of classes and values; empty without sweeps of
/// options.
nlohmann::ordered_json option_sweeps_json(const Statistics& statistics);

}  // namespace nearmiss
