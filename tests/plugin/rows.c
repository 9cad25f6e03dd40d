/* A plug-in for two vertices, and for a vertex and an edge. It reports a query if the numbers in its row are
 * 1, 2, 3 and so on. It takes separations only for a vertex and an edge. The distance bound that it claims is
 * the last coordinate of the row plus the separation. */
#include "ccd/nearmiss_subject.h"

static size_t numbers_of(int kind) { return kind == NEARMISS_VERTEX_VERTEX ? 12 : 18; }

static void decide(void* state, int kind, size_t n, const double* x, const double* h, int* answer,
                   double* toi) {
  (void)state, (void)h, (void)toi;
  for (size_t i = 0; i < n; ++i) {
    answer[i] = NEARMISS_COLLISION;
    for (size_t k = 0; k < numbers_of(kind); ++k)
      if (x[numbers_of(kind) * i + k] != (double)(k + 1)) answer[i] = NEARMISS_NO_COLLISION;
  }
}

static double bound(void* state, int kind, const double* x, double h) {
  (void)state;
  return x[numbers_of(kind) - 1] + h;
}

const nearmiss_subject* nearmiss_get_subject(size_t index) {
  static const nearmiss_subject detector = {.interface_version = NEARMISS_INTERFACE,
                                            .name = "rows",
                                            .kinds = NEARMISS_VERTEX_VERTEX + NEARMISS_VERTEX_EDGE,
                                            .batch = 16,
                                            .decide = decide,
                                            .separation_kinds = NEARMISS_VERTEX_EDGE,
                                            .distance_bound_within = bound};
  return index == 0 ? &detector : NULL;
}
