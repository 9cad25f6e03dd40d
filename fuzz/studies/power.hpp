// The power of a hunt: how soon it finds a known defect.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

#include "fuzz/trial/campaign.hpp"

namespace nearmiss {

/// The first failure that a campaign found, in the order of its cases.
struct FirstFailure {
  Finding finding;
  double seconds = 0;       ///< time until the failure, interpolated within a wave by the number of cases
  std::uint64_t cases = 0;  ///< number of cases up to and including the failure
};

/// Runs a campaign until a subject misses a collision or its distance bound is refuted; nothing if the
/// campaign ends before.
std::optional<FirstFailure> find_first_failure(const CampaignPlan& plan, const Subjects& subjects,
                                               const Stop& stop);

}  // namespace nearmiss
