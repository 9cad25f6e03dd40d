/* A complete example of a plug-in: a conservative test on axis-aligned boxes. It reports every pair whose swept boxes meet,
 * so it never misses a collision. It claims no bound on the distance of its false positives.
 *
 *   cc -shared -fPIC -I. tests/plugin/example.c -o example.so
 *   build/release/nearmiss fuzz --subject ./example.so --cases 100000
 */
#include <stddef.h>

#include "ccd/nearmiss_subject.h"

/* Smallest and largest coordinate k of vertices first..last over both times. */
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

/* One primitive has the vertices 0 .. split - 1, the other split .. 3. */
static int boxes_meet(const double* x, int split) {
  for (int k = 0; k < 3; ++k) {
    double lo_a, hi_a, lo_b, hi_b;
    range(x, k, 0, split - 1, &lo_a, &hi_a);
    range(x, k, split, 3, &lo_b, &hi_b);
    if (hi_a < lo_b || hi_b < lo_a) return 0;
  }
  return 1;
}

static int vertex_triangle(const double* x, double* toi) {
  (void)toi; /* the time is not known */
  return boxes_meet(x, 1);
}

static int edge_edge(const double* x, double* toi) {
  (void)toi;
  return boxes_meet(x, 2);
}

static const nearmiss_subject subject = {NEARMISS_SUBJECT_ABI, "boxes",   "1.0",
                                         vertex_triangle,      edge_edge, NULL};

const nearmiss_subject* nearmiss_get_subject(void) { return &subject; }
