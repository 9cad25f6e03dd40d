// A campaign: what was run, how far it got, and what it found. A store holds campaigns, and a report shows one.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reports/campaign/scene_picture.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// Facts by name.
using RunInfo = std::map<std::string, std::string>;

/// Beginning of the names of facts about a plug-in: "plug-in NAME sha256" and "plug-in NAME version" in a run, and
/// "plug-in NAME", which names it on the command line with its whole path, and "plug-in NAME build id" in the environment of
/// a shard.
inline constexpr std::string_view about_plugin = "plug-in ";
/// Beginning of the name of the fact about a run's built-in subject that was renamed: "subject NAME" is "NAME=SUBJECT".
inline constexpr std::string_view about_subject = "subject ";

/// Whether a fact of a run says which code ran, and not what it was asked to do: the version and the commit of nearmiss,
/// and the bytes and the version of each plug-in.
bool says_which_code(std::string_view fact);

/// A fact that differs between two runs, and its two values; "" if a run does not have it. The command to repeat a run
/// is not compared, because it repeats other facts.
struct DifferentFact {
  std::string name, one, other;
};
std::optional<DifferentFact> different_fact(const RunInfo& one, const RunInfo& other);

/// Name of the fact of a run that says what a salvage lost of it. With this fact, it is another run, so that nothing
/// resumes it.
inline constexpr const char* salvaged_fact = "salvaged";
/// Name of the fact that a salvage gives a run if rows about runs were lost, so that some results are of unknown runs.
inline constexpr const char* origin_fact = "origin";

/// Value of a run's fact "cases" if the run has no limit on the number of cases.
inline constexpr std::string_view until_the_time_is_over = "until the time is over";

/// One machine's part of a run.
struct Shard {
  std::uint64_t index = 0;  ///< position among `count` shards, from 0
  std::uint64_t count = 1;
  std::uint64_t cases = 0;  ///< cases that the oracle decided, in order; a campaign resumes after them
  bool complete = false;
  std::string started = {};  ///< date and time, for people only: clocks jump
  double seconds = 0;        ///< run time so far
  RunInfo environment = {};  ///< machine and compiler; times depend on it, and no other result does

  bool operator==(const Shard&) const = default;
};

/// A command with everything on which its results depend; equal runs give equal results. This includes the code that
/// ran: the commit of nearmiss, and the bytes of each plug-in (`says_which_code`). The compiler of nearmiss, its flags
/// and the path of a plug-in belong to the environment of a shard: answers do not depend on them, so that different
/// machines can share a run.
struct Run {
  RunInfo info;
  std::vector<Shard> shards;      ///< by index
  std::vector<Finding> findings;  ///< in order: the first ones of each signature and class (FirstFindings)
  std::vector<ScenePicture> pictures = {};  ///< by step

  bool operator==(const Run&) const = default;
};

/// Everything that a store holds and a report shows.
struct Campaign {
  std::vector<Run> runs;  ///< by their facts
  Statistics statistics;

  /// The findings of all runs, in the order in which they are shown: those of the oracle first, since they concern all others;
  /// then by the class of the query, ordinary first; by the number of times that the signature was seen; and the simplest
  /// first. If several findings of a signature and class are shrunk to the same query, only the first of them is listed.
  [[nodiscard]] std::vector<Finding> findings() const;
};

/// Several campaigns as one: counters add up, shards of the same run come together, and the first findings of each
/// signature are kept, so that all shards give the campaign that one machine would have run. The result does not depend
/// on the order of the inputs. Throws Error, with the inputs' names, if two have the same shard of a run, divide a run
/// into different numbers of shards, or have runs that differ only in the code that ran. Runs that were asked to do
/// different things, as in different nights, stand side by side.
Campaign merge_campaigns(std::span<const Campaign> campaigns, std::span<const std::string> names);

/// A line that names the missing and the incomplete shards of a run; "" if all shards are complete.
std::string missing_shards(const Run& run);

}  // namespace nearmiss
