/* A subject that reports a query if it may have a limited number of processes, of at least 256. */
#include <stddef.h>
#include <sys/resource.h>

#include "ccd/nearmiss_subject.h"

static int answer(const double* x, double* toi) {
  struct rlimit processes;
  (void)x;
  (void)toi;
  if (getrlimit(RLIMIT_NPROC, &processes) != 0) return 0;
  return processes.rlim_cur >= 256 && processes.rlim_cur < RLIM_INFINITY &&
         processes.rlim_cur == processes.rlim_max;
}

static const nearmiss_subject subject = {NEARMISS_SUBJECT_ABI, "process_limit", "1", answer, answer, NULL};
const nearmiss_subject* nearmiss_get_subject(void) { return &subject; }
