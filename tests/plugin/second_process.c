/* A subject that reports every query, but crashes at each query with x > 0.9. Its first process makes the
 * file that NEARMISS_MARK names. In later processes, the subject cannot be loaded, or has another name
 * (RENAME). */
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include "ccd/nearmiss_subject.h"

static int is_later;

__attribute__((constructor)) static void look(void) {
  is_later = open(getenv("NEARMISS_MARK"), O_CREAT | O_EXCL, 0600) < 0;
#ifndef RENAME
  if (is_later) _exit(5);
#endif
}

static void decide(void* state, int kind, size_t n, const double* x, const double* h, int* answer,
                   double* toi) {
  (void)state, (void)kind, (void)h, (void)toi;
  for (size_t i = 0; i < n; ++i) answer[i] = x[24 * i] > 0.9 ? raise(SIGSEGV) : NEARMISS_COLLISION;
}

const nearmiss_subject* nearmiss_get_subject(size_t index) {
  static nearmiss_subject subject = {.interface_version = NEARMISS_INTERFACE,
                                     .kinds = NEARMISS_VERTEX_TRIANGLE + NEARMISS_EDGE_EDGE,
                                     .decide = decide};
  subject.name = is_later ? "second" : "first";
  return index == 0 ? &subject : NULL;
}
