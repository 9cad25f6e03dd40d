/* A subject that waits a tenth of a millisecond, as if for a device, and reports nothing. */
#define _POSIX_C_SOURCE 200809L
#include <stddef.h>
#include <time.h>

#include "ccd/nearmiss_subject.h"

static int decide(const double* x, double* toi) {
  const struct timespec time = {0, 100000};
  (void)x;
  (void)toi;
  nanosleep(&time, NULL);
  return 0;
}

const nearmiss_subject* nearmiss_get_subject(void) {
  static const nearmiss_subject subject = {NEARMISS_SUBJECT_ABI, "waits", "1", decide, decide, NULL};
  return &subject;
}
