// Directed search: derivative-free optimisation for queries that one subject answers wrongly or nearly
// wrongly.
#pragma once

#include <string_view>
#include <vector>

#include "ccd/subjects/subject.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/stop.hpp"

namespace nearmiss {

/// To return one query, a search asks the subject about at most this many queries.
inline constexpr int search_evaluations = 2000;

/// The aims of directed searches. Each aim has a family, whose queries are the best ones that searches found.
enum class SearchFor {
  /// "search-miss-NAME": a collision that the subject misses; if the search found none, the collision that
  /// came nearest to being missed.
  misses,
  /// "search-far-NAME": the farthest false positive, relative to the subject's claimed bound, or to wang's
  /// bound if the subject claims none. A false positive that refutes the bound ends the search. If a search
  /// finds none, it returns a query that is no false positive.
  far,
  /// "search-late-NAME", for a subject that gives times: the collision for which the subject's time is
  /// latest, compared with t*, the exact earliest time. If the search found a time after t*, it returns the
  /// query with the largest time - t*; otherwise, the query with the smallest (t* - time) / t*. The search
  /// skips misses, and up to 20 queries over the time limit.
  late,
  /// "search-early-NAME": like `late`, but the search looks for the collision with the largest t* - time.
  early,
};

/// The family of a directed search against one subject.
///
/// The search moves on the manifold of contacts, on which the primitives always meet. Half of the searches
/// use a grid on which contact is exact; the others use all bits of a double, and the oracle decides whether
/// the primitives still meet. The search for misses maximises Subject::needed_tolerance(). If the subject
/// does not know this tolerance, the search maximises a random mixture of properties that make a contact
/// hard: a grazing motion, a small angle between the primitives, a small barycentric weight, unequal edges, a
/// time near 0 or 1. The search for far false positives also moves single vertices (README.md). A search
/// starts at random points and continues from the best point so far. A query over the subject's time limit
/// ends the search; after a few such searches, the subject is not asked any more. Making a query throws
/// Stopped when `stop` is due. The subject and `stop` must outlive the family.
///
/// With a separation (parse_family_separation), the name ends with ~SEPARATION. Each search has one
/// separation h > 0, and moves among queries in which two points of the primitives come within h of each
/// other. A smallest distance near h is a further property that makes a query hard.
Family search_for(SearchFor what, const Subject& subject, const Stop& stop = Stop::never(),
                  std::string_view separation = {});

/// The family that runs `search` among vv and ve queries: "v-search-miss-NAME~SEPARATION".
Family among_vertices(Family search);

/// All searches for a subject: for misses, far false positives, and, if it gives times, late and early ones.
/// If the subject decides vv or ve, the searches also run among vv and ve queries. If `separation` is empty,
/// each search among vv and ve queries draws a separation: "v-search-miss-NAME~drawn".
std::vector<Family> searches(const Subject& subject, const Stop& stop = Stop::never(),
                             std::string_view separation = {});

}  // namespace nearmiss
