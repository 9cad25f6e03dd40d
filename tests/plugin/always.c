/* A complete plug-in, which gives all queries the same answer. Macros set the subject's name, the answer, the
 * time of impact, the sort of this time, whether the subject takes a separation, the subject's contract, and
 * the distance bound that it claims. */
#include <stddef.h>
#include <stdlib.h>

#ifndef TIME_SORT
#define TIME_SORT NEARMISS_TIME_ESTIMATE
#endif
#include "tests/plugin/one_by_one.h"

#ifndef ANSWER
#define ANSWER 1
#endif
#ifndef TIME
#define TIME 0.5
#endif
#ifdef BAD_NAME
#define NAME "+1+1\033[31m\xff"
#elif !defined NAME
#define NAME "always"
#endif

static int answer(const double* x, double* toi) {
  (void)x;
  if (ANSWER == 1) *toi = TIME;
  return ANSWER;
}

__attribute__((unused)) static double hang(void) {
  for (volatile int i = 0; i >= 0; i = 0) {
  }
  return 0;
}

#ifdef BOUND
static double claimed_bound(void* state, int kind, const double* x) {
  const int is_edge_edge = kind == NEARMISS_EDGE_EDGE;
  (void)state, (void)x, (void)is_edge_edge;
  return BOUND;
}
#else
#define claimed_bound NULL
#endif

EXPORT_DETECTOR(NAME, answer, claimed_bound)
