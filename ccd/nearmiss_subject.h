/* The plug-in interface of nearmiss, version 4: a shared object that exports nearmiss_get_subject() puts up
 * to 64 continuous collision detectors on trial. C99; this header is the whole interface. A field that an
 * initialiser leaves out is 0. Shared objects that were compiled with version 2 or 3 still work. */
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

/* Answers. A negative number is an error; all other numbers are invalid. */
#define NEARMISS_NO_COLLISION 0
#define NEARMISS_COLLISION 1
#define NEARMISS_UNKNOWN 2 /* cannot tell; counts as a collision, because a user must treat it as one */

/* Sorts of times. */
#define NEARMISS_NO_TIME 0
#define NEARMISS_TIME_ESTIMATE 1
#define NEARMISS_TIME_LOWER_BOUND 2 /* nothing happens before this time */
/* A lower bound, and nothing happens on the shortened step, either: on this step, each vertex moves straight
 * from a, its position at t = 0, to a + toi (b - a), where b is its position at t = 1. Each operation of this
 * formula is rounded to double, or to float if `bits` is 24. The step is judged only if there is a collision.
 */
#define NEARMISS_TIME_FREE_STEP 3

/* Layouts of the coordinates of n queries. */
#define NEARMISS_ROWS 0   /* coordinate k of query i is x[m * i + k], if a query has m coordinates */
#define NEARMISS_ARRAYS 1 /* coordinate k of query i is x[n * k + i] */

/* What a detector requires of a query. It is not judged on queries that do not meet this contract. */
typedef struct {
  int apart_at_start; /* 1: at t = 0, the distance of the primitives exceeds both apart_by and h */
  int one_root;    /* 1: the volume spanned by four vertices has at most one root in [0, 1], a simple one */
  double apart_by; /* used with apart_at_start; 0: the primitives do not touch */
  double grid;     /* if not 0: a power of two of which every coordinate is a multiple */
  double shortest,
      longest; /* if not 0: finite limits of the lengths of all edges at t = 0 and t = 1; no vertex's path is
                  longer than `longest`, either */
} nearmiss_contract;

typedef struct {
  int interface_version; /* NEARMISS_INTERFACE */
  /* The name is unique within the shared object. It is UTF-8 of at most 255 bytes, without control characters
   * and without any of : = / , - `version` and `about` are one line of text each, of which the first 255
   * bytes are shown. */
  const char *name, *version, *about;
  int kinds;            /* sum of the kinds that it decides; 0 if it only gives distances or steps */
  int bits;             /* 53; or 24: it gets x and h rounded to float, and is judged on these; 0 means 53 */
  int time_sort;        /* the sort of time that it gives with every collision */
  int takes_separation; /* 1 if it uses h, for all of its kinds */
  size_t batch;         /* how many queries decide() should get at once, if possible: up to 10^7; 0 means 1 */
  nearmiss_contract contract;

  /* Opens the detector for one thread, and returns its state. `options` is what the user wrote after its
   * name, such as "tolerance=1e-6:iterations=1000", or "". To refuse, it writes a line of at most size - 1
   * bytes to `message`, and returns NULL. If `open` is NULL, the detector has no options, and its state is
   * NULL. */
  void* (*open)(const char* options, char* message, size_t size);
  /* Closes a state; may be NULL. After a tenth of a second, nearmiss ends the process. `close` is not called
   * if a query ended the process, or took too long. A crash in `close` goes unnoticed. */
  void (*close)(void* state);

  /* Decides n queries of one kind: whether the distance of the two primitives is at most the separation h at
   * any time in [0, 1]; h = 0 asks for contact.
   *   x: n rows of finite doubles, x0 x1 .. at t = 0, then at t = 1; x, y, z of each: 24 numbers, or 12 for
   *      two vertices, and 18 for a vertex and an edge. The vertices move linearly. `layout` may change the
   *      order.
   *   h: n separations, at least 0; all 0 unless the detector uses h for this kind. Rounded to float, like x,
   *      if `bits` is 24.
   *   answer: n answers, all to be written.
   *   toi: n times of impact in [0, 1], in the unit of the time step. They are NaN on entry, and matter only
   *        for collisions. If time_sort is not NEARMISS_NO_TIME, a collision without a time in [0, 1] is
   *        invalid. Pass on a NaN that your code computes: it is counted as an invalid answer, which another
   *        number would hide.
   * A C++ exception may leave the function. The query that threw it then has no answer (the fault
   * `exception`), and what() is shown. The same process and state answer the next queries. An answer must
   * depend only on the query's own x and h, and on the options: a failing query is asked again when it is
   * shrunk, and one query in 256 is asked twice. If the answers differ, this is the fault `inconsistent`.
   * Arithmetic rounds to nearest, keeps subnormals and does not trap; if the detector changes this, nearmiss
   * restores it. */
  void (*decide)(void* state, int kind, size_t n, const double* x, const double* h, int* answer, double* toi);

  /* The bound that the detector claims for a query: if the detector reports the query falsely, the distance
   * exceeds h by at most this bound, in the unit of the coordinates. NULL if the detector claims no bound, or
   * if the bound depends on h. */
  double (*distance_bound)(void* state, int kind, const double* x);

  /* New in version 3: */

  int separation_kinds; /* sum of the kinds for which it uses h, if these are not all of its kinds */
  /* The bound, which may depend on h. If this function is not NULL, it is called in place of
   * distance_bound(). */
  double (*distance_bound_within)(void* state, int kind, const double* x, double h);

  /* New in version 4: */

  int distance_kinds; /* sum of the kinds for which distance() is asked; if 0, it is NULL */
  /* The distance of two primitives at rest, in the unit of the coordinates: finite and at least 0. A solver
   * relies on it when it moves them by at most this distance, so a value above the exact distance is unsafe.
   *   x: x, y, z of each vertex: 12 numbers, or 6 for two vertices, and 9 for a vertex and an edge.
   *   weights: the weights of the vertices in the closest points of the two primitives, in the order of x; those
   *      of each primitive add up to 1. They are NaN on entry, and may stay so. */
  double (*distance)(void* state, int kind, const double* x, double* weights);

  int step_kinds; /* sum of the kinds for which step() is asked; if 0, it is NULL */
  /* The part of a step that is safe. Writes the positions to which the vertices may move, instead of those at
   * t = 1, to `y`: 12 numbers, or 6 for two vertices, and 9 for a vertex and an edge. Returns the clearance
   * that it claims, finite and at least 0: while the vertices move straight from their positions at t = 0 to
   * y, the primitives do not come nearer to each other than the clearance; 0 claims that they do not touch. x
   * is one row, as for decide(). */
  double (*step)(void* state, int kind, const double* x, double* y);

  int layout; /* the layout of decide()'s x: NEARMISS_ROWS or NEARMISS_ARRAYS */
  /* The seconds that the last decide() took without copies to and from a device, or a negative number if that
   * is unknown; may be NULL. `nearmiss bench` shows them. */
  double (*seconds_of_kernels)(void* state);
} nearmiss_subject;

/* The one exported function. Returns detector number `index`, from 0; NULL after the last one. The object
 * that it points to stays valid until the shared object is unloaded. */
const nearmiss_subject* nearmiss_get_subject(size_t index);

#ifdef __cplusplus
}
#endif

#endif
