/* A complete plug-in. The return value of its answers and its claimed distance bound are set when it is compiled. */
#include <stddef.h>
#include <stdlib.h>

#include "ccd/nearmiss_subject.h"

#ifndef ANSWER
#define ANSWER 1
#endif
#ifdef BAD_NAME
#define NAME "=1+1\033[31m\xff"
#else
#define NAME "always"
#endif
#ifndef ABI
#define ABI NEARMISS_SUBJECT_ABI
#endif

static int answer(const double* x, double* toi) {
  (void)x;
  if (ANSWER == 1) *toi = 0.5;
  return ANSWER;
}

static inline double hang(void) {
  for (volatile int i = 0; i >= 0; i = 0) {
  }
  return 0;
}

#ifdef BOUND
static double distance_bound(const double* x, int is_edge_edge) {
  (void)x;
  (void)is_edge_edge;
  return BOUND;
}
#else
#define distance_bound NULL
#endif

static const nearmiss_subject subject = {ABI, NAME, "1.0", answer, answer, distance_bound};

const nearmiss_subject* nearmiss_get_subject(void) { return &subject; }
