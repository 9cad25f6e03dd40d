/** \file
 * Exact answers for queries in the caller's memory. C99.
 *
 * The answers are those of exact arithmetic, for all finite coordinates, including huge and subnormal ones
 * and degenerate primitives. Nearly all queries are decided in double arithmetic with certified error bounds,
 * without memory from the heap. Exact arithmetic decides the other queries. It also decides whether there is
 * contact at t = 0 or t = 1, if double arithmetic cannot. Exact arithmetic allocates memory and takes
 * microseconds to milliseconds. The slowest known certificates take tenths of a second; their queries have
 * coordinates of very different sizes. nearmiss_smallest_distance() allocates memory, too. A program cannot
 * go on after an allocation that fails inside GMP or CGAL.
 *
 * Many threads may call all functions at once; each call works in its own thread. The functions set the
 * processor's rounding mode if need be, and restore it. They do not print or throw. */
#ifndef NEARMISS_ORACLE_H
#define NEARMISS_ORACLE_H

#include "ccd/query/queries.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What decided a query. */
#define NEARMISS_BY_BOXES 0  /**< the boxes that the primitives sweep do not meet */
#define NEARMISS_BY_FILTER 1 /**< double arithmetic with certified bounds */
#define NEARMISS_BY_EXACT 2  /**< exact arithmetic */

/* The statements that a certificate proves. */
#define NEARMISS_PROVE_DECISION 0 /**< the answer of nearmiss_collides() */
#define NEARMISS_PROVE_TIME 1     /**< the bounds lo and hi of nearmiss_earliest_time() for a `width` of 0 */
#define NEARMISS_PROVE_DISTANCE 2 /**< bounds of the smallest distance, for a `relative_width` of 1e-3 */

/** Whether each query is a collision: answers[q] is NEARMISS_COLLISION, NEARMISS_NO_COLLISION or
 * NEARMISS_NO_ANSWER. A smallest distance of exactly h, the separation, counts as a collision. `decided_by`
 * receives what decided each query, and may be null. */
int nearmiss_collides(const nearmiss_queries* queries, int8_t* answers, uint8_t* decided_by);

/** The earliest time t* at which the distance is at most h: lo[q] <= t* <= hi[q], where lo and hi are equal
 * if t* is a double, and neighbouring doubles if not. If `width` is above 0, hi - lo may be up to `width`. So
 * lo is a safe time of impact: before lo, the distance is above h. Both lo and hi are infinite if there is no
 * collision, and NaN if there is no answer. `hi` may be null. */
int nearmiss_earliest_time(const nearmiss_queries* queries, double width, double* lo, double* hi);

/** The earliest time as a simulation needs it. answers[q] says whether query q is a collision at some t in
 * [0, tmax]. If so, toi[q] is the largest double that is not after t*; otherwise toi[q] is infinite. If there
 * is no answer, toi[q] is 0, because a simulation must not take that step. tmax must be at most 1. */
int nearmiss_time_of_impact(const nearmiss_queries* queries, double tmax, int8_t* answers, double* toi);

/** The smallest distance d over the step: lo[q] <= d <= hi[q], where hi - lo is at most relative_width * hi,
 * or as small as doubles allow. Both lo and hi are 0 if the primitives touch, and NaN if there is no answer.
 * Separations are ignored. `relative_width` must not be negative. `hi` may be null. */
int nearmiss_smallest_distance(const nearmiss_queries* queries, double relative_width, double* lo,
                               double* hi);

/** The certificate of query q: a proof of the answer, which the short programs in tools/certificates/ of the
 * sources check with fractions alone. A certificate is a text of lines, with '\n' between successive lines.
 * Each line is JSON, and proves one statement about the query:
 *
 *     what                       statements
 *     NEARMISS_PROVE_DECISION    the distance is always above h; or it is at most h at some time
 *     NEARMISS_PROVE_TIME        the distance is above h in [0, lo), unless lo is 0; it is at most h at some
 *                                time in [lo, hi]. Without a collision: the distance is always above h
 *     NEARMISS_PROVE_DISTANCE    the distance is always at least lo, unless lo is 0; it is at most hi at some
 *                                time, unless hi is infinite. Separations are ignored
 *
 * Compare what a line states with what you asked: a line may be a valid proof about another query. If a
 * statement has no proof, its line is left out. This happens only if, at an irrational time, the distance
 * falls to exactly h > 0 and then grows again at once. If no line is left, or there is no answer, the text is
 * empty.
 *
 * `length` is set to the number of characters of the whole text. As with snprintf(), at most `size`
 * characters are written to `text`, including a '\0' at the end, and the rest of the text is cut off. If
 * `size` is 0, nothing is written, and `text` may be null. */
int nearmiss_certificate(const nearmiss_queries* queries, size_t q, int what, char* text, size_t size,
                         size_t* length);

#ifdef __cplusplus
}
#endif

#endif
