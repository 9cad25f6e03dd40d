/** \file
 * A trial of a CCD inside its own program, such as a unit test: nearmiss asks a detector hard queries, judges
 * its answers exactly, and simplifies the queries on which it fails. trial.hpp has the same in C++. C99.
 *
 * The detector runs in the caller's process, so a crash of it ends that process, and an endless loop never
 * returns; `nearmiss fuzz` runs detectors in processes of their own. Nothing is written to files.
 */
#ifndef NEARMISS_TRIAL_H
#define NEARMISS_TRIAL_H

#include <stddef.h>
#include <stdint.h>

#include "ccd/nearmiss_subject.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What is asked, and how long. A value of 0 or NULL stands for what the comment says. */
typedef struct {
  size_t size;          /**< sizeof(nearmiss_trial_options) */
  const char* families; /**< names with ',' between them (nearmiss fuzz --help); NULL or "": all */
  const char*
      separation;    /**< of each query: a positive number, or "drawn"; NULL or "": contact, but of vertices
                               and edges, which hardly ever touch, a drawn separation */
  const char* check; /**< the macro in which the text puts its example; NULL: "assert" */
  int kinds;         /**< sum of kinds; 0: all that the detector decides */
  int threads;       /**< how many call the detector at once; 0: one */
  uint64_t seed;     /**< of the random queries */
  uint64_t cases;    /**< number of queries; 0: as many as there is time for */
  double seconds;    /**< for the queries, and a second more to simplify some; 0: no limit */
} nearmiss_trial_options;

/** Counters of the detector's answers. */
typedef struct {
  uint64_t queries;         /**< that it was asked */
  uint64_t collisions;      /**< true collisions among the queries that it answered */
  uint64_t missed;          /**< collisions that it did not report */
  uint64_t missed_class[3]; /**< `missed` by class: ordinary, degenerate, extreme */
  uint64_t false_positives; /**< queries that it reported although they are no collisions */
  uint64_t unknown;         /**< queries that it reported because it could not tell */
  uint64_t late;            /**< promised lower bounds of the time that are after contact */
  uint64_t unsafe_steps;    /**< steps that are promised to be free and have contact */
  uint64_t beyond_bound;    /**< false positives that are farther apart than the detector claims */
  uint64_t no_answer;       /**< queries without a valid answer, because of an exception or otherwise */
  uint64_t beyond_contract; /**< queries that it was not asked, because they break its contract */
} nearmiss_trial_counts;

/** A query on which the detector fails. */
typedef struct {
  const char* what;        /**< "false-negative", "late", "unsafe-step", "refuted-bound" or "fault" */
  const char* query_class; /**< "ordinary", "degenerate" or "extreme" */
  const char* family;      /**< in which it was found */
  const char* explanation; /**< what happens in it */
  const char*
      certificate;   /**< the proof that the detector is wrong (tools/certificates/README.md); "": none */
  int kind;          /**< its kind */
  double x[24];      /**< the simplest such query: its coordinates, as nearmiss_subject.h orders them */
  double separation; /**< and its separation */
} nearmiss_trial_finding;

/** The result of a trial. */
typedef struct {
  int is_clean;                           /**< 1 if the detector was asked, and never failed */
  const char* text;                       /**< at most 15 lines, the most ordinary failure first */
  nearmiss_trial_counts all;              /**< counters of all kinds */
  nearmiss_trial_counts of_kind[4];       /**< those of each: vt, ee, vv, ve */
  size_t finding_count;                   /**< length of `findings` */
  const nearmiss_trial_finding* findings; /**< the first of each way to fail, the most ordinary ones first */
} nearmiss_trial_result;

/** Puts a detector on trial. Its functions get `state` first; open() and close() are not called. If
 * `threads` is more than 1, several threads call it at once. Returns a result, which nearmiss_free_trial()
 * releases, or NULL and a line in `message`, which has `size` bytes: for a name or a number that is not
 * known, or if there is no memory. */
nearmiss_trial_result* nearmiss_hold_trial(const nearmiss_subject* detector, void* state,
                                           const nearmiss_trial_options* options, char* message, size_t size);

/** Releases a result; NULL is allowed. */
void nearmiss_free_trial(nearmiss_trial_result* result);

/** Queries `first` to `first + n - 1` of a kind of a family, for loops of one's own. `x` gets n rows of
 * coordinates, as nearmiss_subject.h orders them, and `separation` n numbers; it may be NULL if the family
 * asks for contact. Returns 1, or 0 and a line in `message`. */
int nearmiss_hard_queries(const char* family, int kind, uint64_t seed, uint64_t first, size_t n, double* x,
                          double* separation, char* message, size_t size);

#ifdef __cplusplus
}
#endif

#endif
