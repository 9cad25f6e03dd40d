// A campaign as the results of tests, for systems of continuous integration.
#pragma once

#include <string>

#include "reports/campaign/campaign.hpp"
#include "reports/statistics/failure.hpp"

namespace nearmiss {

/// JUnit's XML: a suite for each subject, with a test for each kind and class of families. A test fails if
/// one of `failing` is in its counters; its text then has the failures in words, at most three queries, which
/// nearmiss replay reads, and the command that repeats the run. If the oracle failed, so does a suite of its
/// own.
std::string junit_xml(const Campaign& campaign, const Failures& failing = usual_failures());

/// Lines that GitHub's workflows show as annotations: one for each failure of a subject, and of the oracle.
std::string github_annotations(const Campaign& campaign, const Failures& failing = usual_failures());

}  // namespace nearmiss
