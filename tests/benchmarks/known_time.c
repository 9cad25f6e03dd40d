/* A subject whose run time is that of STEPS multiply-adds. */
#include "tests/benchmarks/known_time.h"

#include <stddef.h>

#include "ccd/nearmiss_subject.h"

static int decide(const double* x, double* toi) {
  (void)toi;
  return known_time(x, STEPS);
}

const nearmiss_subject* nearmiss_get_subject(void) {
  static const nearmiss_subject subject = {NEARMISS_SUBJECT_ABI, "known", "1", decide, decide, NULL};
  return &subject;
}
