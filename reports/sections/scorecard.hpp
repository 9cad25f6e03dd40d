// The page's first table: a row for each subject.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "reports/campaign/campaign.hpp"
#include "reports/sections/baseline.hpp"
#include "reports/sections/shown.hpp"
#include "reports/statistics/failure.hpp"

namespace nearmiss {

/// An object for each subject, in the order of their names. It has the subject's verdict; its failures, the
/// gravest first; its place on the ladder of precisions; its rates over all kinds, as a whole and class by
/// class; its run times; the number of changes since the baseline; and the index of its simplest failure
/// among the findings that are shown (null without findings).
nlohmann::ordered_json scorecard_json(const Statistics& statistics, const std::vector<ShownFinding>& findings,
                                      const std::optional<Changes>& since,
                                      const Failures& failing = usual_failures());

}  // namespace nearmiss
