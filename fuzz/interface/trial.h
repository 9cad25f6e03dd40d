/** \file
 * A trial of a CCD inside a program that uses it, such as a unit test: nearmiss asks a detector hard queries,
 * judges its answers exactly, and simplifies the queries on which it fails. This header is C99; trial.hpp
 * offers trials in C++.
 *
 * The detector runs in the caller's process: if it crashes, the process ends, and if it loops forever, the
 * trial never returns. `nearmiss fuzz` runs detectors in processes of their own. A trial writes no files.
 */
#ifndef NEARMISS_TRIAL_H
#define NEARMISS_TRIAL_H

#include <stddef.h>
#include <stdint.h>

#include "ccd/nearmiss_subject.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The queries and the length of a trial. The comments say what 0 and NULL mean. */
typedef struct {
  size_t size;            /**< sizeof(nearmiss_trial_options) */
  const char* families;   /**< names, separated by commas (nearmiss fuzz --help); NULL or "": all */
  const char* separation; /**< h of each query: a positive number, or "drawn"; NULL or "": vt and ee ask
                               about contact, vv and ve have drawn separations */
  const char* check;      /**< the macro that checks the example in a report; NULL: "assert" */
  int kinds;              /**< sum of kinds; 0: all that the detector decides */
  int threads;            /**< how many threads call the detector at once; 0: one */
  uint64_t seed;          /**< the seed of the random queries */
  uint64_t cases;         /**< number of queries; 0: until `seconds` are over */
  double seconds;         /**< time for the queries; simplification gets one second more; 0: no limit */
} nearmiss_trial_options;

/** Counters of the detector's answers. */
typedef struct {
  uint64_t queries;         /**< queries that the detector was asked */
  uint64_t collisions;      /**< true collisions among the answered queries */
  uint64_t missed;          /**< collisions reported as no collision */
  uint64_t missed_class[3]; /**< `missed` by class: ordinary, degenerate, extreme */
  uint64_t false_positives; /**< reported queries that are no collisions */
  uint64_t unknown;         /**< queries reported because the detector could not tell */
  uint64_t late;            /**< times after the first contact, although promised to be lower bounds */
  uint64_t unsafe_steps;    /**< steps with contact, although promised to be free of it */
  uint64_t beyond_bound; /**< false positives whose primitives are farther apart than the detector claims */
  uint64_t no_answer;    /**< queries without a valid answer, because of an exception or another fault */
  uint64_t beyond_contract; /**< queries not asked, because they break the detector's contract */
} nearmiss_trial_counts;

/** A query on which the detector fails. */
typedef struct {
  const char* what;        /**< "false-negative", "late", "unsafe-step", "refuted-bound" or "fault" */
  const char* query_class; /**< "ordinary", "degenerate" or "extreme" */
  const char* family;      /**< the family that made the query */
  const char* explanation; /**< what happens in the query */
  const char*
      certificate;   /**< the proof that the detector is wrong (tools/certificates/README.md); "": none */
  int kind;          /**< NEARMISS_VERTEX_TRIANGLE and so on */
  double x[24];      /**< coordinates as in nearmiss_subject.h; simplified only in the first finding of each
                          way to fail, for up to three ways */
  double separation; /**< the separation of the query */
} nearmiss_trial_finding;

/** The result of a trial. */
typedef struct {
  int is_clean;                           /**< 1 if the detector was asked, and never failed */
  const char* text;                       /**< a report of at most 15 lines */
  nearmiss_trial_counts all;              /**< counters of all kinds */
  nearmiss_trial_counts of_kind[4];       /**< counters of each kind: vt, ee, vv, ve */
  size_t finding_count;                   /**< length of `findings` */
  const nearmiss_trial_finding* findings; /**< the first few of each way to fail, ordinary queries first */
} nearmiss_trial_result;

/** Puts a detector on trial. The detector's functions get `state` as their first argument; open() and
 * close() are not called. Returns a result, which nearmiss_free_trial() releases. If an option has an unknown
 * name or an invalid number, or memory runs out, returns NULL and writes one line to `message`, which has
 * `size` bytes. */
nearmiss_trial_result* nearmiss_hold_trial(const nearmiss_subject* detector, void* state,
                                           const nearmiss_trial_options* options, char* message, size_t size);

/** Releases a result; NULL is allowed. */
void nearmiss_free_trial(nearmiss_trial_result* result);

/** Makes queries `first` to `first + n - 1` of one kind in a family, for the caller's own loops. Writes n
 * rows of coordinates, in the order of nearmiss_subject.h, to `x`, and n numbers to `separation`, which may
 * be NULL if the family asks for contact. Returns 1; on failure, returns 0 and writes one line to
 * `message`. */
int nearmiss_hard_queries(const char* family, int kind, uint64_t seed, uint64_t first, size_t n, double* x,
                          double* separation, char* message, size_t size);

#ifdef __cplusplus
}
#endif

#endif
