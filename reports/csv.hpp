// A campaign as CSV files (RFC 4180).
#pragma once

#include <string>

#include "reports/campaign/campaign.hpp"

namespace nearmiss {

/// A row for each subject, kind and family. The last column is the family's class.
std::string statistics_csv(const Statistics& statistics);

/// A row for each subject, kind and class of families, with the counters of statistics_csv.
std::string classes_csv(const Statistics& statistics);

/// A row for each non-empty bin of the distance histograms.
std::string distances_csv(const Statistics& statistics);

/// A row for each non-empty bin of the histograms of times. The column "side" says what the histogram
/// counts: t* - time if it is "early", time - t* if it is "after".
std::string times_csv(const Statistics& statistics);

/// A row for each finding. "shrunk" and "query" are queries as to_line writes them; "seen" is the number of
/// queries that failed with the same signature.
std::string findings_csv(const Campaign& campaign);

}  // namespace nearmiss
