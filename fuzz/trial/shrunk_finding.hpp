// Shrinking a finding: the simplest query that fails in the same way.
#pragma once

#include <chrono>

#include "ccd/query.hpp"
#include "ccd/subject.hpp"
#include "fuzz/stop.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// The finding's query, shrunk to one that fails with the same signature. `subject` may be null for a failure
/// of the oracle. A query that the subject refuses does not fail. A contradiction to a recorded truth cannot
/// be shrunk, because the truth is known for one query only. The search ends when the subject's answers have taken as long
/// as `limit`: a subject that is very slow is asked few queries. Throws Stopped.
Query shrunk_query(const Finding& finding, const Subject* subject, const Stop& stop = Stop::never(),
                   std::chrono::milliseconds limit = std::chrono::minutes(1));

}  // namespace nearmiss
