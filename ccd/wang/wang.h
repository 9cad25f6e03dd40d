/** \file
 * The failure-proof CCD of Wang (2014) for queries in the caller's memory. C99.
 *
 * The CCD reports every collision, also in degenerate and extreme queries. It may report a pair that does not
 * collide, but the primitives of such a pair come within the distance that nearmiss_wang_bound() gives. The
 * CCD takes separations for two vertices (Algorithm 1), and for a vertex and an edge (Algorithm 2). For the
 * other kinds, every separation must be 0; otherwise the functions return NEARMISS_BAD_ARGUMENT.
 *
 * Any number of threads may call the functions at once. The functions set the processor to round to nearest
 * and to keep subnormals, and restore the caller's mode at the end. They do not allocate, print or throw. */
#ifndef NEARMISS_WANG_H
#define NEARMISS_WANG_H

#include "ccd/query/queries.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Writes the CCD's answer to query q to answers[q]: NEARMISS_COLLISION, NEARMISS_NO_COLLISION or
 * NEARMISS_NO_ANSWER. Returns a status (queries.h). */
int nearmiss_wang(const nearmiss_queries* queries, int8_t* answers);

/** Writes a bound for query q to bounds[q], in the unit of the coordinates: if the CCD reports the query, the
 * smallest distance in the step exceeds the separation by at most this bound. For contact, the bound is about
 * 41 B ε^¼, where B is the size of the pair and ε the machine epsilon of double. For a separation h, the
 * bound is about 2 h + 28 B ε^¼ for a vertex and an edge, and much less for two vertices. The bound is NaN if
 * the answer is NEARMISS_NO_ANSWER. Returns a status. */
int nearmiss_wang_bound(const nearmiss_queries* queries, double* bounds);

#ifdef __cplusplus
}
#endif

#endif
