/* A subject that reports every query, unless a comment below says otherwise. What its process does with a
 * query is chosen when it is compiled. */
#define _GNU_SOURCE
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <time.h>

#include "tests/plugin/one_by_one.h"

#if defined(ABORTS_LATER)
/* The first answer starts a thread, which ends the process after 0 to 4 ms. */
#define NAME "aborts-later"
static void* abort_later(void* unused) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  const struct timespec later = {0, now.tv_nsec % 4000000};
  nanosleep(&later, NULL);
  abort();
  return unused;
}

static int answer(void) {
  static int is_started = 0;
  pthread_t thread;
  if (!is_started) is_started = pthread_create(&thread, NULL, abort_later, NULL) == 0;
  return 1;
}
#elif defined(COMPUTES)
/* Uses COMPUTES seconds of CPU time for each query. */
#define NAME "computes"
static double computed(void) {
  struct timespec time;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static int answer(void) {
  const double start = computed();
  while (computed() - start < COMPUTES) {
  }
  return 1;
}
#elif defined(WAITS)
/* Waits a tenth of a millisecond, as if for a device, and reports nothing. */
#define NAME "waits"
static int answer(void) {
  const struct timespec time = {0, 100000};
  nanosleep(&time, NULL);
  return 0;
}
#elif defined(PROCESS_LIMIT)
/* Reports a query if the number of its processes is limited to at least 256, and it may not write a core
 * dump. */
#define NAME "process_limit"
static int answer(void) {
  struct rlimit processes, core;
  if (getrlimit(RLIMIT_NPROC, &processes) != 0 || getrlimit(RLIMIT_CORE, &core) != 0 || core.rlim_max != 0)
    return 0;
  return processes.rlim_cur >= 256 && processes.rlim_cur < RLIM_INFINITY &&
         processes.rlim_cur == processes.rlim_max;
}
#elif defined(RECOVERS)
/* Asks for more memory than is allowed, and continues when that is refused. Its process crashes at the next
 * query. */
#define NAME "recovers"
static int answer(void) {
  static int calls = 0;
  if (++calls == 2) return raise(SIGSEGV);
  void* volatile const refused = malloc((size_t)1 << 40);
  free(refused);
  return 1;
}
#endif

static int test(const double* x, double* toi) {
  (void)x, (void)toi;
  return answer();
}

EXPORT_DETECTOR(NAME, test, NULL)
