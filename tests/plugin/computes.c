/* A subject that uses an eighth of a second of CPU time for each query, and reports every query. */
#define _POSIX_C_SOURCE 200809L
#include <stddef.h>
#include <time.h>

#include "ccd/nearmiss_subject.h"

static double computed(void) {
  struct timespec time;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static int test(const double* x, double* toi) {
  const double start = computed();
  (void)x;
  (void)toi;
  while (computed() - start < 0.125) {
  }
  return 1;
}

static const nearmiss_subject subject = {NEARMISS_SUBJECT_ABI, "computes", "1", test, test, NULL};
const nearmiss_subject* nearmiss_get_subject(void) { return &subject; }
