// Single queries that a report shows: what failed, and the farthest false positives; each is a case file too.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "corpus/case.hpp"
#include "reports/campaign.hpp"

namespace nearmiss {

/// A case on its way into the report's folder.
struct Exported {
  std::string file;
  Case content;
};

/// A finding, its shrunk query, and the query that was found.
struct ShownFinding {
  Finding finding;
  std::uint64_t seen;
  Exported shrunk, original;
};

/// The findings to show, the first ones of each signature, with files numbered for each subject and sort.
std::vector<ShownFinding> shown_findings(const Campaign& campaign);

/// The command that shows a finding again, run in the report's folder: with the plug-in where the machine
/// that found it has it, and its limits and bound.
std::string replay_command(const Campaign& campaign, const ShownFinding& shown);

/// The farthest false positive of one subject, kind and family.
struct ShownFarthest {
  Key key;
  FarCase far;
  Exported exported;
};

/// Of all that have one, in the order of their keys.
std::vector<ShownFarthest> farthest_cases(const Statistics& statistics);

}  // namespace nearmiss
