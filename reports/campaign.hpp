// A campaign: what was run, how far, and what it gave. What a store holds and a report shows.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reports/scene_picture.hpp"
#include "reports/statistics.hpp"

namespace nearmiss {

/// Facts by name.
using RunInfo = std::map<std::string, std::string>;

/// What a run's fact "cases" says where no number of them ends it.
inline constexpr std::string_view until_the_time_is_over = "until the time is over";

/// What one machine does of a run.
struct Part {
  std::uint64_t shard = 0;  ///< this one of `shards`
  std::uint64_t shards = 1;
  std::uint64_t rounds = 0;  ///< of blocks, done: what a campaign goes on from
  std::uint64_t cases = 0;   ///< decided by the oracle
  bool complete = false;     ///< nothing is left to be done
  std::string started = {};  ///< a date, for people only: clocks jump
  double seconds = 0;        ///< that it took so far
  RunInfo environment = {};  ///< machine and compiler, on which no result depends, only times

  bool operator==(const Part&) const = default;
};

/// A command with all on which its results depend; equal ones give equal results.
struct Run {
  RunInfo info;
  std::vector<Part> parts;        ///< by shard
  std::vector<Finding> findings;  ///< in order; the first ones of each signature, as many as are kept
  std::vector<ScenePicture> pictures = {};  ///< by step

  bool operator==(const Run&) const = default;
};

/// Everything that a store holds and a report shows.
struct Campaign {
  std::vector<Run> runs;  ///< by their facts
  Statistics statistics;

  /// The findings of all runs, those of one signature together; of those that are shrunk to the same query
  /// the first one.
  [[nodiscard]] std::vector<Finding> findings() const;
};

/// How many findings of each signature a run keeps; Statistics::seen counts all.
inline constexpr std::size_t findings_kept = 3;

/// Several campaigns as one: counters add up, parts of the same run come together, and of its findings the
/// first ones are kept, so that all shards give the campaign that one machine would have run. The result does
/// not depend on the order of the inputs. Throws Error, with the inputs' names, where two have the same part
/// of a run, or cut it differently.
Campaign merge_campaigns(std::span<const Campaign> campaigns, std::span<const std::string> names);

/// The shards of a run that are missing, or not complete, in a line; "" where there is none.
std::string missing_parts(const Run& run);

}  // namespace nearmiss
