/* A subject that makes the file NEARMISS_MARK when it is closed. With HANG, the subject's close function
 * never returns. */
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include "ccd/nearmiss_subject.h"

static void* open_it(const char* options, char* message, size_t size) {
  (void)options, (void)message, (void)size;
  return malloc(1);
}

static void close_it(void* state) {
  free(state);
  const char* const name = getenv("NEARMISS_MARK");
  FILE* const mark = name != NULL ? fopen(name, "w") : NULL;
  if (mark != NULL) fclose(mark);
#ifdef HANG
  for (volatile int i = 0; i >= 0; i = 0) {
  }
#endif
}

static void decide(void* state, int kind, size_t n, const double* x, const double* h, int* answer,
                   double* toi) {
  (void)state, (void)kind, (void)x, (void)h, (void)toi;
  for (size_t i = 0; i < n; ++i) answer[i] = NEARMISS_COLLISION;
}

const nearmiss_subject* nearmiss_get_subject(size_t index) {
  static const nearmiss_subject detector = {.interface_version = NEARMISS_INTERFACE,
                                            .name = "closes",
                                            .kinds = NEARMISS_VERTEX_TRIANGLE + NEARMISS_EDGE_EDGE,
                                            .open = open_it,
                                            .close = close_it,
                                            .decide = decide};
  return index == 0 ? &detector : NULL;
}
