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

/// The first failure that a campaign found, in the order of the campaign's cases.
struct FirstFailure {
  Finding finding;
  /// The time until the failure. A campaign gives the time only after each batch of cases, so this time is
  /// interpolated between two batches, in proportion to the number of cases.
  double seconds = 0;
  std::uint64_t cases = 0;  ///< number of cases up to and including the case that failed
};

/// Returns the families in which to look for a subject's defects. These are the families `of_contact`. If the
/// subject takes separations for vertex-triangle queries, the families `of_contact` are returned a second
/// time, with a random separation in each query. If the subject takes separations for vertex-vertex or
/// vertex-edge queries, the result also has the families `of_vertices`, changed by as_asked().
std::vector<Family> families_for(const Subject& subject, std::span<const Family> of_contact,
                                 std::span<const Family> of_vertices);

/// Runs a campaign until a subject misses a collision, refutes its distance bound, or gives a time of impact
/// that is too late. Returns nothing if the campaign ends without such a failure.
std::optional<FirstFailure> find_first_failure(const CampaignPlan& plan, const Subjects& subjects,
                                               const Stop& stop);

}  // namespace nearmiss
