// A campaign as CSV files (RFC 4180).
#pragma once

#include <string>

#include "reports/campaign/campaign.hpp"

namespace nearmiss {

/// A row for each subject, kind and family. The last column is the family's class.
std::string statistics_csv(const Statistics& statistics);

/// A row for each subject, kind and class of families, with the same counters.
std::string classes_csv(const Statistics& statistics);

/// A row for each non-empty bin of the distance histograms.
std::string distances_csv(const Statistics& statistics);

/// A row for each non-empty bin of the histograms of times: t* - time on the side "early", time - t* on the
/// side "after".
std::string times_csv(const Statistics& statistics);

/// A row for each finding. "shrunk" and "query" are 24 hex floats each, or 25 with a separation, as in a
/// query file; "seen" is the number of queries that failed with the same signature.
std::string findings_csv(const Campaign& campaign);

}  // namespace nearmiss
