// A campaign as the results of tests, for systems of continuous integration.
#pragma once

#include <string>

#include "reports/campaign/campaign.hpp"
#include "reports/statistics/failure.hpp"

namespace nearmiss {

/// JUnit's XML: a suite for each subject, with a test for each kind and class of families. A test fails if
/// its counters have one of the failures in `failing`; its text then has these failures in words, at most
/// three queries in the form that nearmiss replay reads, and the command that repeats the run. If the oracle
/// failed, the suite "oracle" fails.
std::string junit_xml(const Campaign& campaign, const Failures& failing = usual_failures());

/// Lines that GitHub's workflows show as annotations: one for each failure of a subject or of the oracle.
std::string github_annotations(const Campaign& campaign, const Failures& failing = usual_failures());

}  // namespace nearmiss
