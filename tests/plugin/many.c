/* COUNT detectors, each with a name of as many bytes as are allowed. */
#include <stdio.h>
#include <string.h>

#include "ccd/nearmiss_subject.h"

#define LONGEST 255

static void decide(void* state, int kind, size_t n, const double* x, const double* h, int* answer,
                   double* toi) {
  (void)state, (void)kind, (void)x, (void)h, (void)toi;
  for (size_t i = 0; i < n; ++i) answer[i] = NEARMISS_NO_COLLISION;
}

const nearmiss_subject* nearmiss_get_subject(size_t index) {
  static char names[COUNT][LONGEST + 1];
  static nearmiss_subject detectors[COUNT];
  if (index >= COUNT) return NULL;
  memset(names[index], 'n', LONGEST);
  snprintf(names[index] + LONGEST - 2, 3, "%02d", (int)index);
  detectors[index].interface_version = NEARMISS_INTERFACE;
  detectors[index].name = names[index];
  detectors[index].kinds = NEARMISS_VERTEX_TRIANGLE + NEARMISS_EDGE_EDGE;
  detectors[index].decide = decide;
  return &detectors[index];
}
