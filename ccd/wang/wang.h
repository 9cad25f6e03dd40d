/** \file
 * The failure-proof CCD of Wang (2014) for queries in the caller's memory. C99.
 *
 * It reports every collision, also in degenerate and extreme queries. It may report a pair that does not
 * collide, but the primitives of such a pair come within the distance that nearmiss_wang_bound() gives. It
 * takes separations for two vertices (Algorithm 1), and for a vertex and an edge (Algorithm 2). For the other
 * kinds, every separation must be 0, or the result is NEARMISS_BAD_ARGUMENT.
 *
 * Many threads may call all functions at once. The functions set the processor's rounding mode if need be,
 * and restore it. They do not allocate, print or throw. */
#ifndef NEARMISS_WANG_H
#define NEARMISS_WANG_H

#include "ccd/query/queries.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Whether the CCD reports each query: answers[q] is NEARMISS_COLLISION, NEARMISS_NO_COLLISION or
 * NEARMISS_NO_ANSWER. */
int nearmiss_wang(const nearmiss_queries* queries, int8_t* answers);

/** For each query, the most by which the smallest distance of a reported pair exceeds the separation, in the
 * unit of the coordinates. For contact, this is about 41 B ε^¼, where B is the size of the pair and ε the
 * machine epsilon of double. For a separation h, it is about 2 h + 28 B ε^¼ for a vertex and an edge, and
 * much less for two vertices. NaN if there is no answer. */
int nearmiss_wang_bound(const nearmiss_queries* queries, double* bounds);

#ifdef __cplusplus
}
#endif

#endif
