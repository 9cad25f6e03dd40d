// Directed search: derivative-free optimisation for queries that one subject answers wrongly or nearly
// wrongly.
#pragma once

#include <string_view>
#include <vector>

#include "ccd/subjects/subject.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/stop.hpp"

namespace nearmiss {

/// A search returns one query. To find it, the search asks the subject about at most this many queries.
inline constexpr int search_evaluations = 2000;

/// The aims of directed searches. Each aim has a family; each query of the family is the best query that one
/// search found.
enum class SearchFor {
  /// "search-miss-NAME": a collision that the subject misses or, if the search found no such collision, the
  /// one that came nearest to being missed.
  misses,
  /// "search-far-NAME": the farthest false positive. Its distance is measured relative to the bound that the
  /// subject claims, or to wang's bound if the subject claims none. A false positive that refutes the claimed
  /// bound ends the search. If a search finds no false positive, it returns some other query.
  far,
  /// "search-late-NAME", for a subject that gives times: the collision for which the subject's time is
  /// latest, compared with t*, the exact earliest time. If the search found a time after t*, it returns the
  /// query with the largest time - t*; otherwise, the query with the smallest (t* - time) / t*. The search
  /// skips misses, and up to 20 queries over the time limit.
  late,
  /// "search-early-NAME", for a subject that gives times: the collision with the largest t* - time. As for
  /// `late`, the search skips misses, and up to 20 queries over the time limit.
  early,
};

/// The family of a directed search against one subject.
///
/// The searches for misses and for times move among queries in which the primitives meet by construction.
/// Half of these searches use a grid on which contact is exact. The others use all bits of a double, so that
/// rounding errors may separate the primitives; the oracle decides whether they still meet. The search for
/// far false positives also moves the primitives apart, and moves single vertices (README.md). The search for
/// misses maximises Subject::needed_tolerance(). If the subject does not know this tolerance, the search
/// maximises a random mixture of properties that make a contact hard: a grazing motion, a small angle between
/// the sides, a small barycentric weight, sides of unequal length, a time near 0 or 1, and primitives that
/// are small compared with their relative motion. A search starts at random points and continues from the
/// best point so far. In searches for misses and for far false positives, a query over the subject's time
/// limit ends the search. After a few searches that were so slow, the subject is not asked any more. Making a
/// query throws Stopped when `stop` is due. The subject and `stop` must outlive the family.
///
/// With a separation (parse_family_separation), the name ends with ~SEPARATION. Each search has one
/// separation h > 0, and moves among queries in which two points of the primitives come within h of each
/// other. For h > 0, the mixture has a further property that makes a query hard: a smallest distance near h.
Family search_for(SearchFor what, const Subject& subject, const Stop& stop = Stop::never(),
                  std::string_view separation = {});

/// The family that runs `search` among vv and ve queries: "v-search-miss-NAME~SEPARATION".
Family among_vertices(Family search);

/// All searches for a subject: for misses, for far false positives and, if the subject gives times, for late
/// and early times. If the subject decides vv or ve, the result also has these searches among vv and ve
/// queries. If `separation` is empty, each search among vv and ve queries draws a separation:
/// "v-search-miss-NAME~drawn".
std::vector<Family> searches(const Subject& subject, const Stop& stop = Stop::never(),
                             std::string_view separation = {});

}  // namespace nearmiss
