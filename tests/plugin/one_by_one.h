/* Makes a plug-in with one detector from a function that answers one query. */
#ifndef NEARMISS_TESTS_ONE_BY_ONE_H
#define NEARMISS_TESTS_ONE_BY_ONE_H

#include "ccd/nearmiss_subject.h"

#ifndef TIME_SORT
#define TIME_SORT NEARMISS_NO_TIME
#endif
#ifndef TAKES_SEPARATION
#define TAKES_SEPARATION 0
#endif
#ifndef BATCH
#define BATCH 0
#endif
#ifndef CONTRACT
#define CONTRACT \
  { 0, 0, 0, 0, 0, 0 }
#endif
#ifndef KINDS
#define KINDS (NEARMISS_VERTEX_TRIANGLE + NEARMISS_EDGE_EDGE)
#endif

/* Exports a detector with the name `text`. It answers test(x, toi), and claims `bound` if that is not NULL. */
#define EXPORT_DETECTOR(text, test, bound)                                                         \
  static void decide_one_by_one(void* state, int kind, size_t n, const double* x, const double* h, \
                                int* answers, double* times) {                                     \
    (void)state, (void)kind, (void)h;                                                              \
    for (size_t i = 0; i < n; ++i) answers[i] = (test)(x + 24 * i, times + i);                     \
  }                                                                                                \
  NEARMISS_EXPORTED const nearmiss_subject* nearmiss_get_subject(size_t index) {                   \
    static const nearmiss_subject detector = {.interface_version = NEARMISS_INTERFACE,             \
                                              .name = (text),                                      \
                                              .version = "1",                                      \
                                              .about = "",                                         \
                                              .kinds = KINDS,                                      \
                                              .bits = 0,                                           \
                                              .time_sort = TIME_SORT,                              \
                                              .takes_separation = TAKES_SEPARATION,                \
                                              .batch = BATCH,                                      \
                                              .contract = CONTRACT,                                \
                                              .open = NULL,                                        \
                                              .close = NULL,                                       \
                                              .decide = decide_one_by_one,                         \
                                              .distance_bound = (bound),                           \
                                              .separation_kinds = 0,                               \
                                              .distance_bound_within = NULL,                       \
                                              .distance_kinds = 0,                                 \
                                              .distance = NULL,                                    \
                                              .step_kinds = 0,                                     \
                                              .step = NULL,                                        \
                                              .layout = NEARMISS_ROWS,                             \
                                              .seconds_of_kernels = NULL};                         \
    return index == 0 ? &detector : NULL;                                                          \
  }

#ifdef __cplusplus
#define NEARMISS_EXPORTED extern "C"
#else
#define NEARMISS_EXPORTED
#endif

#endif
