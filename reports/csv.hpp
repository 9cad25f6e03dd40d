// A campaign as CSV files (RFC 4180).
#pragma once

#include <string>

#include "reports/campaign.hpp"

namespace nearmiss {

/// A row for each subject, kind and family.
std::string statistics_csv(const Statistics& statistics);

/// A row for each bin of the distance histograms that is not empty.
std::string distances_csv(const Statistics& statistics);

/// A row for each finding; shrunk and query are 24 hex floats each, as in a query file; seen counts all
/// findings with its signature.
std::string findings_csv(const Campaign& campaign);

}  // namespace nearmiss
