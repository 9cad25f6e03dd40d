// A campaign as CSV files (RFC 4180).
#pragma once

#include <string>

#include "reports/campaign/campaign.hpp"

namespace nearmiss {

/// statistics.csv: a row for each subject, kind and family. The last column is the family's class.
std::string statistics_csv(const Statistics& statistics);

/// classes.csv: a row for each subject, kind and class of families, with the counters of statistics.csv.
std::string classes_csv(const Statistics& statistics);

/// distances.csv: a row for each non-empty bin of the histograms of distances.
std::string distances_csv(const Statistics& statistics);

/// times.csv: a row for each non-empty bin of the histograms of time errors. Let t* be the exact earliest
/// time. If the column "side" is "early", the error is t* - time; if it is "after", the error is time - t*.
std::string times_csv(const Statistics& statistics);

/// findings.csv: a row for each finding. The columns "shrunk" and "query" have queries as to_line writes
/// them; "seen" is the number of queries that failed with the finding's signature.
std::string findings_csv(const Campaign& campaign);

}  // namespace nearmiss
