// The options of a campaign, which the commands fuzz, ladder and tightness run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/arguments.hpp"
#include "tools/record.hpp"
#include "tools/trial_options.hpp"

namespace nearmiss::tools {

struct CampaignOptions {
  TrialOptions trial;
  std::vector<std::string> families{"all"}, sweeps;
  /// Short names of the kinds to ask. If the list is empty, the campaign asks the kinds that kinds_to_ask()
  /// gives.
  std::vector<std::string> kinds;
  SeparationOption separation;
  int steps = 17;
  bool search = false;
  std::vector<std::string> mesh;            ///< the arguments of open_scene()
  std::vector<std::filesystem::path> near;  ///< files and folders of queries
  std::uint64_t cases = 0, first = 0;
  std::string time, shard = "0/1";
  std::uint64_t seed = 1;
  RecordOptions record;
};

/// Runs the campaign, or the rest of a stored campaign, and records the results. Returns the exit code.
/// Throws Error for bad options, and if results cannot be stored.
int record_campaign(const CampaignOptions& options);

}  // namespace nearmiss::tools
