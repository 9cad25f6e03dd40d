/* A complete example of a plug-in: a conservative test on axis-aligned boxes. It reports every pair whose
 * swept boxes meet, so it never misses a collision. It claims no bound on the distance of its false
 * positives.
 *
 *   cc -shared -fPIC -I. tests/plugin/example.c -o example.so
 *   build/release/nearmiss fuzz --subject ./example.so --cases 100000
 */
#include <stddef.h>

#include "ccd/nearmiss_subject.h"

/* Finds the smallest and the largest coordinate k that the vertices first to last have at t = 0 or t = 1. */
static void range(const double* x, int k, int first, int last, double* lo, double* hi) {
  *lo = *hi = x[3 * first + k];
  for (int time = 0; time < 2; ++time) {
    for (int vertex = first; vertex <= last; ++vertex) {
      const double c = x[12 * time + 3 * vertex + k];
      if (c < *lo) *lo = c;
      if (c > *hi) *hi = c;
    }
  }
}

/* The vertices 0 to split - 1 belong to one primitive, and the vertices split to 3 to the other. */
static int boxes_meet(const double* x, int split) {
  for (int k = 0; k < 3; ++k) {
    double lo_a, hi_a, lo_b, hi_b;
    range(x, k, 0, split - 1, &lo_a, &hi_a);
    range(x, k, split, 3, &lo_b, &hi_b);
    if (hi_a < lo_b || hi_b < lo_a) return 0;
  }
  return 1;
}

static void decide(void* state, int kind, size_t n, const double* x, const double* h, int* answer,
                   double* toi) {
  const int split = kind == NEARMISS_VERTEX_TRIANGLE ? 1 : 2;
  (void)state; /* there are no options */
  (void)h;     /* it decides only contact */
  (void)toi;   /* the time is not known */
  for (size_t i = 0; i < n; ++i)
    answer[i] = boxes_meet(x + 24 * i, split) ? NEARMISS_COLLISION : NEARMISS_NO_COLLISION;
}

static const nearmiss_subject boxes = {
    .interface_version = NEARMISS_INTERFACE,
    .name = "boxes",
    .version = "1.0",
    .about = "whether the axis-aligned boxes around the moving primitives meet",
    .kinds = NEARMISS_VERTEX_TRIANGLE + NEARMISS_EDGE_EDGE,
    .decide = decide,
};

const nearmiss_subject* nearmiss_get_subject(size_t index) { return index == 0 ? &boxes : NULL; }
