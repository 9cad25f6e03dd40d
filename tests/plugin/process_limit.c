/* A subject that reports a query if it may have a limited number of processes, of at least 256, and may write no core
 * dump. */
#include <stddef.h>
#include <sys/resource.h>

#include "tests/plugin/one_by_one.h"

static int answer(const double* x, double* toi) {
  struct rlimit processes, core;
  (void)x;
  (void)toi;
  if (getrlimit(RLIMIT_NPROC, &processes) != 0 || getrlimit(RLIMIT_CORE, &core) != 0 || core.rlim_max != 0)
    return 0;
  return processes.rlim_cur >= 256 && processes.rlim_cur < RLIM_INFINITY &&
         processes.rlim_cur == processes.rlim_max;
}

EXPORT_DETECTOR("process_limit", answer, NULL)
