// The power of a campaign: how soon it finds a known defect.
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

/// The families with which to look for a subject's defects: `of_contact`. If the subject takes separations
/// for vertex-triangle queries, also `of_contact` with drawn separations. If it takes separations for
/// vertex-vertex or vertex-edge queries, also `of_vertices`, changed by as_asked().
std::vector<Family> families_for(const Subject& subject, std::span<const Family> of_contact,
                                 std::span<const Family> of_vertices);

/// Runs a campaign until a subject misses a collision, refutes its distance bound, or gives a late time.
/// Returns nothing if the campaign ends without such a failure.
std::optional<FirstFailure> find_first_failure(const CampaignPlan& plan, const Subjects& subjects,
                                               const Stop& stop);

}  // namespace nearmiss
