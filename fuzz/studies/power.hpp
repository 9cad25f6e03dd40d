// The power of a hunt: how soon it finds a known defect.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fuzz/trial/campaign.hpp"

namespace nearmiss {

/// The first failure that a campaign found, in the order of its cases.
struct FirstFailure {
  Finding finding;
  double seconds = 0;  ///< time until the failure, interpolated between two results by the number of cases
  std::uint64_t cases = 0;  ///< number of cases up to and including the failure
};

/// The families of contact; for a subject that takes separations, also the same families with drawn
/// separations; for one that takes them for vertices and edges, also the families of these, as they are
/// asked.
std::vector<Family> families_for(const Subject& subject, std::span<const Family> of_contact,
                                 std::span<const Family> of_vertices);

/// Runs a campaign until a subject misses a collision, its distance bound is refuted, or its time is late;
/// nothing if the campaign ends before.
std::optional<FirstFailure> find_first_failure(const CampaignPlan& plan, const Subjects& subjects,
                                               const Stop& stop);

}  // namespace nearmiss
