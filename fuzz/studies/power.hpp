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

/// The first failure that a campaign found. Failures are ordered as the cases of the campaign are.
struct FirstFailure {
  Finding finding;
  /// The time until the failure. It is interpolated between two results of the campaign, by the numbers of
  /// cases that these results have.
  double seconds = 0;
  std::uint64_t cases = 0;  ///< number of cases up to and including the case that failed
};

/// Returns the families in which to look for a subject's defects: `of_contact` and, if the subject takes
/// separations for vertex-triangle queries, also the same families with a random separation in each query. If
/// the subject takes separations for vertex-vertex or vertex-edge queries, also returns the families
/// `of_vertices`, changed by as_asked().
std::vector<Family> families_for(const Subject& subject, std::span<const Family> of_contact,
                                 std::span<const Family> of_vertices);

/// Runs a campaign until a subject misses a collision, refutes its distance bound, or gives a time of impact
/// that is too late. Returns nothing if the campaign ends without such a failure.
std::optional<FirstFailure> find_first_failure(const CampaignPlan& plan, const Subjects& subjects,
                                               const Stop& stop);

}  // namespace nearmiss
