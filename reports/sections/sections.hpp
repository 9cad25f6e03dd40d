// The sections of a report that follow from the counters of a campaign: as text for the terminal, and as JSON
// for report.json. Texts and lists are empty if there is nothing to show.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "reports/statistics/failure.hpp"

namespace nearmiss {

/// The lines of the verdicts on subjects (verdicts.hpp), a line for each pair of versions, the number of
/// certified truths, and the tolerances that were measured. Only the failures in `failing` count.
std::string summary_lines(const Statistics& statistics, const Failures& failing = usual_failures());
/// A longer summary. Its parts are, in this order:
///   the lines of summary_lines on subjects and versions
///   the sizes at which subjects are right
///   a table with a row for each subject and kind
///   a table of times of impact and a table of other counters, with a row for each subject, kind and class
///   the factors that misses have in common
///   the oracle's counters, and the measured tolerances
std::string summary_table(const Statistics& statistics, const Failures& failing = usual_failures());

/// The edge lengths and the distances from the origin at which each subject is right (right_ranges). A
/// subject has one row if its ranges are the same for all kinds, otherwise a row for each kind.
std::string sizes_table(const Statistics& statistics);
nlohmann::ordered_json sizes_json(const Statistics& statistics);

/// "89 % of the missed ones have scale=1e-6, and 20 % of all". The first percentage is of the missed
/// collisions, the second is of all collisions.
std::string to_text(const CommonFactors& common);
/// The values of factors (properties that a family varies) that missed collisions have in common: a line (or
/// an object in JSON) for each subject, kind and family with factors and misses.
std::string common_factors_lines(const Statistics& statistics);
nlohmann::ordered_json common_factors_json(const Statistics& statistics);

/// Versions of a CCD, compared query by query: a line for each pair, "new against old: 12 fixed, 3 broken, 41
/// both fail, of 5,000 queries (ordinary vt 3 broken; ...)". If only one of the two versions was asked about
/// a kind, the line also says that this kind is not compared.
std::string version_lines(const Statistics& statistics);
/// A list with an object for each pair of versions, class of families and kind.
nlohmann::ordered_json versions_json(const Statistics& statistics);

/// The pairs of each scene and what became of them: a table for each scene over all its steps, with a line
/// for each PairFate and a column for each kind.
std::string funnel_tables(const Statistics& statistics);
/// An object with a member for each step of a scene. The member of a step has a member for each kind, with
/// the value that funnel_json (measures.hpp) makes.
nlohmann::ordered_json funnels_json(const Statistics& statistics);

/// A table for each simulated scene, with a line for each subject.
std::string simulation_tables(const Statistics& statistics);
/// An object with a member for each scene, which has a member for each subject. The member of a subject has
/// the list "step" with the numbers of the steps, and for each counter of SimulatedStep a list of its values
/// in these steps.
nlohmann::ordered_json simulations_json(const Statistics& statistics);

/// A table for each sweep of a family and each subject, with a row for each value of the family's parameter.
/// Then a table for each sweep of an option, with a row for each class and value, and with the sweep's cliff:
/// the neighbouring values between which the rate of misses changes most.
std::string sweep_tables(const Statistics& statistics);
/// An object with a member for each swept family, which has a member for each subject. The member of a
/// subject is a list with an entry for each value of the family's parameter, in increasing order of the
/// values.
nlohmann::ordered_json sweeps_json(const Statistics& statistics);
/// An object with a list for each pattern NAME:KEY=*. The entries of a list are in the order of classes, and
/// within a class in the order of values.
nlohmann::ordered_json option_sweeps_json(const Statistics& statistics);
nlohmann::ordered_json cliffs_json(const Statistics& statistics);

/// Some subjects pass a query on to another decider, such as exact arithmetic, if their own algorithm is not
/// sure. Each such subject has a table, with a row for all families together, then a row for each family. A
/// row says how many queries each decider decided. It also has two quotients: the subject's run time divided
/// by the run time of wang, and divided by the run time of exact, each over the kinds and families for which
/// both subjects have times.
std::string decider_tables(const Statistics& statistics);
nlohmann::ordered_json deciders_json(const Statistics& statistics);

/// The ladder of precisions (one algorithm in several scalar types): a row for each subject on the ladder,
/// and fits that say which power of the scalar's ε the distance of the farthest false positive follows.
/// Returns "" unless an algorithm has at least two precisions.
std::string ladder_table(const Statistics& statistics);
nlohmann::ordered_json ladder_json(const Statistics& statistics);

/// Error against run time, over the kinds and families that all compared subjects were asked about:
///   "left_out"            the names of the timed subjects that are not compared
///   "subjects"            for each subject ns_per_query, rates, the farthest distance, the sort of its
///                         times, and the median, the 99 % quantile and the largest magnitude of time - t*,
///                         where t* is the exact earliest time; if the time is a sound lower bound, this
///                         magnitude says how early it is
///   "front_by_distance"   the Pareto front by the farthest distance
///   "front_by_rate"       the Pareto front by the rate of false positives
///   "front_by_earliness"  the Pareto front by the 99 % quantile of earliness, for sound lower bounds
///   "ladder"              only if an algorithm has at least three scalars: its "front_by_distance" is a
///                         front by distances in units of B, the size of a pair, because fractions of
///                         different bounds cannot be compared; its "paper_bound" is wang's bound in double
nlohmann::ordered_json trade_offs_json(const Statistics& statistics);

/// A subject's place on a precision ladder (one algorithm in several scalar types). For a subject that is not
/// on a ladder, the algorithm is the subject itself.
struct LadderPlace {
  std::string algorithm;  ///< the subject's name without the scalar: "wang-eps:h=0.001@0.5"
  std::string scalar;
  int epsilon_exponent = 0;
  /// The bound by which the distances of false positives are divided, in units of B, the size of a query's
  /// pair. Nothing if the bound is not known.
  std::optional<double> unit;
};

LadderPlace place_of(const std::string& subject);

nlohmann::ordered_json place_json(const LadderPlace& place);

}  // namespace nearmiss
