// Directed search: derivative-free optimisation for queries that one subject answers wrongly or nearly
// wrongly.
#pragma once

#include <string_view>
#include <vector>

#include "ccd/subjects/subject.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/stop.hpp"

namespace nearmiss {

/// A search asks the subject about at most this many queries for each query that it returns.
inline constexpr int search_evaluations = 2000;

/// The family "search-miss-NAME". Each query is a collision that the subject misses, or else the one that it
/// came nearest to missing.
///
/// The search moves on the manifold of contacts, on which the primitives always meet. Half of the searches
/// use a grid on which contact is exact; the others use all bits of a double, and the oracle decides whether
/// the primitives still meet. The search maximises Subject::needed_tolerance(). If the subject has none,
/// it maximises a random mixture of properties that make a contact hard: a grazing motion, a small angle
/// between the primitives, a small weight, unequal edges, a time near 0 or 1. It starts at random points and
/// continues from the best one so far. A query over the subject's time limit ends the search; after a few
/// such searches, the subject is not asked any more. Making a query throws Stopped when `stop` is due. The
/// subject and `stop` must outlive the family.
///
/// With a separation (parse_family_separation), the family is "search-miss-NAME~SEPARATION". Each search has
/// one separation h > 0. It moves among queries in which two points of the primitives come within h, and a
/// smallest distance near h counts as hard, too.
Family miss_search(const Subject& subject, const Stop& stop = Stop::never(),
                   std::string_view separation = {});

/// The family "search-far-NAME". Each query is the farthest false positive that a search found, relative to
/// the bound that the subject claims, or to wang's bound if it claims none. A false positive that refutes the
/// bound ends the search. If a search finds no false positive, it returns another query. Besides contacts and
/// gaps, the search moves vertices: plane culling compares their coordinates, and hardly any change of the
/// contact keeps a far pair unseparated by all planes. All else is as for miss_search.
Family far_search(const Subject& subject, const Stop& stop = Stop::never(), std::string_view separation = {});

/// The family "search-late-NAME", for a subject that gives times. Each query is the collision with the latest
/// time that a search found, compared with t*, the exact earliest time. If any time is after t*, this is the
/// one with the largest difference time - t*, otherwise the one with the smallest (t* - time) / t*. Misses
/// are passed over, and so are up to 20 queries over the time limit. All else is as for miss_search.
Family late_search(const Subject& subject, const Stop& stop = Stop::never(),
                   std::string_view separation = {});

/// The family "search-early-NAME", for a subject that gives times. Each query is the collision with the
/// largest t* - time that a search found. All else is as for late_search.
Family early_search(const Subject& subject, const Stop& stop = Stop::never(),
                    std::string_view separation = {});

/// The same search among two vertices, and a vertex and an edge: "v-search-miss-NAME~SEPARATION".
Family among_vertices(Family search);

/// All searches for a subject: for misses, far false positives, and, if it gives times, late and early ones.
/// For a subject that decides two vertices, or a vertex and an edge, these are also made among such queries,
/// which draw their separations if none is given: "v-search-miss-NAME~drawn".
std::vector<Family> searches(const Subject& subject, const Stop& stop = Stop::never(),
                             std::string_view separation = {});

}  // namespace nearmiss
