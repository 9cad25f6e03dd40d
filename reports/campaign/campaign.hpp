// A campaign: what was run, how far the runs got, and what they found.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "reports/campaign/scene_picture.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// A key to sort findings for display: by the class of the query, then shrunk findings before unshrunk ones,
/// then by the exoticness() of the shrunk query.
inline auto least_exotic_first(const Finding& finding) {
  return std::tuple(finding.query_class, !finding.is_shrunk, exoticness(finding.shrunk, finding.query_class));
}

/// Facts about a run, or about the machine of a shard (one machine's part of a run), by name.
using RunInfo = std::map<std::string, std::string>;

/// The value of a fact; "" if `info` does not have the fact.
std::string fact(const RunInfo& info, const std::string& name);

/// Names of facts about plug-ins begin with this text. A run has the facts "plug-in NAME sha256" and "plug-in
/// NAME version". If the user chose NAME (--subject NAME=...), the fact "plug-in NAME detector" has the name
/// that the plug-in gives itself. The environment of a shard has the facts "plug-in NAME build id" and
/// "plug-in NAME". The value of the latter is the argument of --subject that names the plug-in, with an
/// absolute path.
inline constexpr std::string_view about_plugin = "plug-in ";
inline constexpr std::string_view its_digest = " sha256";
inline constexpr std::string_view its_detector = " detector";
/// Names of a run's facts about renamed built-in subjects begin with this text: the fact "subject NAME" has
/// the value "NAME=SUBJECT".
inline constexpr std::string_view about_subject = "subject ";

/// Whether a fact of a run, given by its name, says which code ran. Other facts say what the code was asked
/// to do. The facts that say which code ran are the version and the commit of nearmiss, and all facts about
/// plug-ins.
bool says_which_code(std::string_view fact);

/// The facts of a run that say what the run was asked to do. Leaves out the facts that say which code ran,
/// and the facts that a salvage adds.
RunInfo task_of(const RunInfo& info);

/// A fact that differs between two runs: its name, and its values in the two runs. A value is "" if the run
/// does not have the fact.
struct DifferentFact {
  std::string name, one, other;
};
/// The first fact that differs between `one` and `other`, if any. The fact "again", which has the command
/// that repeats a run, is not compared, because it says no more than the other facts.
std::optional<DifferentFact> different_fact(const RunInfo& one, const RunInfo& other);

/// Name of the fact that says what a run lost when its store was salvaged. This fact makes the salvaged run
/// differ from the original run, so no command resumes the salvaged run.
inline constexpr const char* salvaged_fact = "salvaged";
/// Name of the fact that a salvage gives to every run of a store if rows about runs or shards were lost. In
/// such a store, some results may belong to a run that is no longer known.
inline constexpr const char* origin_fact = "origin";

/// Value of a run's fact "cases" if the run has no limit on the number of cases.
inline constexpr std::string_view until_the_time_is_over = "until the time is over";

/// One machine's part of a run.
struct Shard {
  std::uint64_t index = 0;  ///< the position of this shard among the `count` shards of the run, from 0
  std::uint64_t count = 1;
  /// The number of cases that this shard has decided so far. A shard decides its cases in order, so a resumed
  /// run goes on with the next case.
  std::uint64_t cases = 0;
  bool complete = false;
  std::string started = {};  ///< date and time of the start; only people read it, because clocks may jump
  double seconds = 0;        ///< run time so far
  RunInfo environment = {};  ///< facts about machine and compiler, on which only run times depend

  bool operator==(const Shard&) const = default;
};

/// A command and its results. `info` has all facts on which the results depend, including the code that ran
/// (`says_which_code`), so runs with equal facts give equal results. Answers do not depend on the compiler,
/// its flags or the path of a plug-in. These facts are in the environment of a shard, so that different
/// machines can share a run.
struct Run {
  RunInfo info;
  std::vector<Shard> shards;  ///< by index
  /// the first findings of each signature and class (FirstFindings), in the order of the cases
  std::vector<Finding> findings;
  std::vector<ScenePicture> pictures = {};  ///< by step

  bool operator==(const Run&) const = default;
};

/// Everything that a store holds and a report shows.
struct Campaign {
  std::vector<Run> runs;  ///< by their facts
  Statistics statistics;

  /// The findings of all runs in the order of display. Failures of the oracle come first, since they put all
  /// other findings in doubt. Findings that never count (beyond a contract) or count only on request
  /// (--fail-on) come last. Within each of these three groups, findings are sorted by `least_exotic_first`,
  /// then by how often their signatures were seen (the most frequent first), then by signature, then by the
  /// complexity() of their shrunk queries. If several findings have the same signature, class, `broken_since`
  /// and shrunk query, only the first of them is listed.
  [[nodiscard]] std::vector<Finding> findings() const;
};

/// Merges campaigns into one: adds up counters, puts the shards of each run together, and keeps the first
/// findings of each signature. If all shards of a run are merged, the result is the campaign that one machine
/// would have run. The result does not depend on the order of the inputs. Runs with different tasks, such as
/// those of different nights, stay separate. Throws an Error that names the inputs if two inputs have the
/// same shard of a run or the same step of a simulation; if they divide a run into different numbers of
/// shards; if they have runs that differ only in the code that ran; if different runs asked a subject the
/// same queries; or if two inputs use one name for different subjects. Also throws Error if one of several
/// inputs has results of an unknown run (origin_fact).
Campaign merge_campaigns(std::span<const Campaign> campaigns, std::span<const std::string> names);

/// A line that names the missing and the incomplete shards of a run; "" if all shards are complete.
std::string missing_shards(const Run& run);

}  // namespace nearmiss
