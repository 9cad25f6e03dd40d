/* A subject that uses SECONDS of CPU time for each query, an eighth if not defined, and reports every query. */
#define _POSIX_C_SOURCE 200809L
#include <stddef.h>
#include <time.h>

#include "tests/plugin/one_by_one.h"

#ifndef SECONDS
#define SECONDS 0.125
#endif

static double computed(void) {
  struct timespec time;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static int test(const double* x, double* toi) {
  const double start = computed();
  (void)x;
  (void)toi;
  while (computed() - start < SECONDS) {
  }
  return 1;
}

EXPORT_DETECTOR("computes", test, NULL)
