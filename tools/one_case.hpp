// Text that a replay of a single case prints.
#pragma once

#include <string>

#include "ccd/query/query.hpp"
#include "fuzz/trial/trial.hpp"
#include "reports/campaign/campaign.hpp"
#include "reports/statistics/failure.hpp"

namespace nearmiss::tools {

/// The only case of a replay.
struct OneCase {
  Query query;
  std::string file;     ///< the name of the file on the command line; "" if the file may have further cases
  std::string options;  ///< options that `nearmiss shrink` needs besides --subject, each after a blank
};

/// At most twelve lines, of at most 100 columns unless a name is long. They say how each subject answers
/// (subjects that fail come first), what is true, what the query is, what the first subject that fails wrote
/// to standard error, and which commands simplify the query and make a test of it.
std::string describe(const OneCase& one, const Campaign& campaign, const Subjects& subjects,
                     const Failures& failing);

}  // namespace nearmiss::tools
