/* The plug-in interface of nearmiss, version 4. A plug-in is a shared object that exports
 * nearmiss_get_subject(), and with it up to 64 continuous collision detectors. This header, in C99, is the
 * whole interface. A field that an initialiser leaves out is 0. Shared objects that were compiled with
 * version 2 or 3 of this header still work. */
#ifndef NEARMISS_SUBJECT_H
#define NEARMISS_SUBJECT_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define NEARMISS_INTERFACE 4

/* Kinds of queries. */
#define NEARMISS_VERTEX_TRIANGLE 1 /* vertex x0, triangle x1 x2 x3 */
#define NEARMISS_EDGE_EDGE 2       /* edges x0x1 and x2x3 */
#define NEARMISS_VERTEX_VERTEX 4   /* vertices x0 and x1 */
#define NEARMISS_VERTEX_EDGE 8     /* vertex x0, edge x1x2 */

/* Answers. A detector may also answer with a negative number, an error code of its own. All other numbers are
 * invalid. */
#define NEARMISS_NO_COLLISION 0
#define NEARMISS_COLLISION 1
#define NEARMISS_UNKNOWN 2 /* cannot tell; counts as a collision, since users must treat this answer as one */

/* Sorts of times. */
#define NEARMISS_NO_TIME 0
#define NEARMISS_TIME_ESTIMATE 1
#define NEARMISS_TIME_LOWER_BOUND 2 /* before this time, the distance exceeds h */
/* A lower bound toi, with a promise about the step that is shortened to toi: the distance exceeds h while
 * each vertex moves straight from a to a + toi (b - a). Here a is the vertex's position at t = 0, and b its
 * position at t = 1. Each operation of this formula is rounded to double, or to float if `bits` is 24. The
 * shortened step is judged only if the exact answer is a collision. */
#define NEARMISS_TIME_FREE_STEP 3

/* Layouts of the coordinates of n queries. */
#define NEARMISS_ROWS 0   /* coordinate k of query i is x[m * i + k], where a query has m coordinates */
#define NEARMISS_ARRAYS 1 /* coordinate k of query i is x[n * k + i] */

/* The contract of a detector: the properties that it requires of a query. The detector is not judged on
 * queries that break its contract. */
typedef struct {
  int apart_at_start; /* 1: at t = 0, the distance of the primitives exceeds both apart_by and h */
  int one_root;       /* 1: the volume of the four vertices has at most one root t in [0, 1], a simple root */
  double apart_by;    /* used with apart_at_start; 0: the primitives do not touch */
  double grid;        /* if not 0: a power of two of which every coordinate is a multiple */
  double shortest,
      longest; /* if not 0: finite limits of the lengths of all edges at t = 0 and t = 1; no vertex's path is
                  longer than `longest`, either */
} nearmiss_contract;

/* Describes one detector. In the comments on the right, "it" is the detector. */
typedef struct {
  int interface_version; /* NEARMISS_INTERFACE */
  /* The name is unique within the shared object. It is UTF-8 of at most 255 bytes, without control
   * characters, colons, equals signs, slashes and commas. `version` and `about` are one line of text each, of
   * which nearmiss shows the first 255 bytes. */
  const char *name, *version, *about;
  int kinds;            /* sum of the kinds that it decides; 0 if it only gives distances or filters steps */
  int bits;             /* 24: it gets, and is judged on, x and h rounded to float; otherwise 53 or 0 */
  int time_sort;        /* the sort of the time that it gives with each collision */
  int takes_separation; /* 1 if it uses h for all of its kinds */
  size_t batch;         /* the number of queries that decide() should get at once: up to 10^7; 0 means 1 */
  nearmiss_contract contract;

  /* Opens the detector for one thread, and returns a state for the functions below. `options` is what the
   * user wrote after the detector's name, such as "tolerance=1e-6:iterations=1000", or "". To refuse the
   * options, the function writes a line of at most size - 1 bytes to `message`, and returns NULL. If `open`
   * is NULL, the detector has no options, and its state is NULL. */
  void* (*open)(const char* options, char* message, size_t size);
  /* Closes a state. The pointer `close` may be NULL. If `close` takes longer than a tenth of a second,
   * nearmiss ends the process. nearmiss does not call `close` after a query that ended the process or took
   * too long, and ignores a crash in `close`. */
  void (*close)(void* state);

  /* Decides n queries of one kind: whether the distance of the two primitives is at most the separation h at
   * any time in [0, 1]; h = 0 asks for contact.
   *   x: n rows of finite doubles. A row has the coordinates x, y, z of x0 x1 .. at t = 0, then those at
   *      t = 1: 24 numbers, or 12 for two vertices, and 18 for a vertex and an edge. The vertices move
   *      linearly. With the layout NEARMISS_ARRAYS, the numbers have another order.
   *   h: n separations, each at least 0. If the detector does not use h for this kind, all are 0. If `bits`
   *      is 24, h and x are rounded to float.
   *   answer: n answers, all to be written.
   *   toi: n times of impact in [0, 1], as fractions of the time step. All are NaN on entry, and nearmiss
   *        reads only the times of collisions. If time_sort is not NEARMISS_NO_TIME, a collision without a
   *        time in [0, 1] is invalid. If your code computes NaN, do not replace the NaN by a number: NaN is
   *        counted as an invalid answer, and a number would hide the fault.
   * The function may throw a C++ exception. The query for which it throws then has no answer (the fault
   * `exception`), and what() is shown. The same process and state answer the next queries. An answer must
   * depend only on the options and on the query's own x and h, because nearmiss asks some queries again: a
   * failing query while nearmiss simplifies it, and one query in 256. Different answers to a query are the
   * fault `inconsistent`. On entry, arithmetic rounds to nearest, keeps subnormals and does not trap. If the
   * detector changes this mode, nearmiss restores the mode. */
  void (*decide)(void* state, int kind, size_t n, const double* x, const double* h, int* answer, double* toi);

  /* The bound that the detector claims for a query, in the unit of the coordinates. If the detector reports
   * the query falsely, the smallest distance in the step exceeds h by at most this bound. The pointer is NULL
   * if the detector claims no bound, or if the bound depends on h. */
  double (*distance_bound)(void* state, int kind, const double* x);

  /* New in version 3: */

  int separation_kinds; /* if the detector uses h only for some of its kinds: the sum of those kinds */
  /* The bound that the detector claims, as for distance_bound(), but this bound may depend on h. If this
   * function is not NULL, nearmiss calls it in place of distance_bound(). */
  double (*distance_bound_within)(void* state, int kind, const double* x, double h);

  /* New in version 4: */

  int distance_kinds; /* sum of the kinds for which distance() is called; 0 if distance() is NULL */
  /* The distance of two primitives at rest, in the unit of the coordinates: finite and at least 0. A solver
   * moves the primitives by up to this distance, so a result above the exact distance is unsafe.
   *   x: the coordinates x, y, z of each vertex: 12 numbers, or 6 for two vertices, and 9 for a vertex and an
   *   edge. weights: for each vertex, in the order of x, its weight in the closest point of its primitive.
   *   The
   *      weights of each primitive add up to 1. All weights are NaN on entry, and may stay NaN. */
  double (*distance)(void* state, int kind, const double* x, double* weights);

  int step_kinds; /* sum of the kinds for which step() is called; 0 if step() is NULL */
  /* Filters the step of one query. `x` is the query's row of coordinates, as for decide(). The function
   * writes to `y` the positions to which the vertices may safely move in place of their positions at t = 1:
   * 12 numbers, or 6 for two vertices, and 9 for a vertex and an edge. It returns a clearance, finite and at
   * least 0. The detector claims that the distance of the primitives is at least the clearance while the
   * vertices move straight from their positions at t = 0 to y. A clearance of 0 claims that the primitives do
   * not touch. */
  double (*step)(void* state, int kind, const double* x, double* y);

  int layout; /* the layout of decide()'s x: NEARMISS_ROWS or NEARMISS_ARRAYS */
  /* How many seconds the last call of decide() took, without the copies to and from a device; a negative
   * number if the detector does not know this time. `nearmiss bench` shows the time. The pointer may be
   * NULL. */
  double (*seconds_of_kernels)(void* state);
} nearmiss_subject;

/* The one exported function. Returns detector number `index`, or NULL if there are no more than `index`
 * detectors. The result stays valid until the shared object is unloaded. */
const nearmiss_subject* nearmiss_get_subject(size_t index);

#ifdef __cplusplus
}
#endif

#endif
