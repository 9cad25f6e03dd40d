// The power of detection: how soon a hunt finds a known defect.
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
  double seconds = 0;       ///< until then; interpolated within a wave, in proportion to the cases
  std::uint64_t cases = 0;  ///< until then, including the failure's own
};

/// Runs a campaign until a subject misses a collision or its distance bound is refuted. Nothing if the campaign ends
/// before.
std::optional<FirstFailure> find_first_failure(const CampaignPlan& plan, const Subjects& subjects,
                                               const std::atomic<bool>& stop);

}  // namespace nearmiss
