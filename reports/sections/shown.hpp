// Single queries that a report shows as case files: findings, and the farthest false positives.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "corpus/case.hpp"
#include "reports/campaign/campaign.hpp"

namespace nearmiss {

/// A case, and the name of its file in the report's folder.
struct Exported {
  std::string file;
  Case content;
};

/// A finding, with the cases of its shrunk query and of its original query.
struct ShownFinding {
  Finding finding;
  std::uint64_t seen;
  Exported shrunk, original;
};

/// The first findings of each signature and class (FirstFindings), in the order of Campaign::findings. The
/// numbers in file names start at 1 for each kind of failure and each subject; subjects whose file names
/// differ only in upper and lower case share numbers.
std::vector<ShownFinding> shown_findings(const Campaign& campaign);

/// The command that replays a finding in the report's folder. It has the run's --bound and, for a plug-in,
/// the run's limits of time and memory. If the subject is a plug-in, the command has the path of the plug-in
/// on the machine that found the failure.
std::string replay_command(const Campaign& campaign, const ShownFinding& shown);

struct ShownFarthest {
  CountsKey key;
  FarCase far;
  DistanceUnit unit;
  Exported exported;
};

/// The farthest false positive of each subject, kind and family that has one, in the order of their keys.
/// File names differ even if upper and lower case are not distinguished.
std::vector<ShownFarthest> farthest_cases(const Statistics& statistics);

}  // namespace nearmiss
