/* A subject whose run time is known: the time of STEPS multiply-adds per query. */
#include "tests/benchmarks/known_time.h"

#include <stddef.h>

#include "tests/plugin/one_by_one.h"

static int decide(const double* x, double* toi) {
  (void)toi;
  return known_time(x, STEPS);
}

EXPORT_DETECTOR("known", decide, NULL)
