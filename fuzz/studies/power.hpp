// The power of detection: how soon a hunt finds a defect that is known to be there.
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
  double seconds = 0;       ///< until then; within what is decided at once, in proportion to the cases
  std::uint64_t cases = 0;  ///< until then, that of the failure included
};

/// Runs a campaign until one of the subjects misses a collision or has its distance bound refuted; nothing
/// where it is over before.
std::optional<FirstFailure> find_first_failure(const CampaignPlan& plan, const Subjects& subjects,
                                               const std::atomic<bool>& stop);

}  // namespace nearmiss
