/* A subject that waits a tenth of a millisecond, as if for a device, and reports nothing. */
#define _POSIX_C_SOURCE 200809L
#include <stddef.h>
#include <time.h>

#include "tests/plugin/one_by_one.h"

static int decide(const double* x, double* toi) {
  const struct timespec time = {0, 100000};
  (void)x;
  (void)toi;
  nanosleep(&time, NULL);
  return 0;
}

EXPORT_DETECTOR("waits", decide, NULL)
