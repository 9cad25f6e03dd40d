/* A subject that reports every query. A thread that its first answer starts ends the process after 0 to 4 ms. */
#include <pthread.h>
#include <stdlib.h>
#include <time.h>

#include "tests/plugin/one_by_one.h"

static void* abort_later(void* unused) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  const struct timespec later = {0, now.tv_nsec % 4000000};
  nanosleep(&later, NULL);
  abort();
  return unused;
}

static int test(const double* x, double* toi) {
  static int is_started = 0;
  (void)x, (void)toi;
  pthread_t thread;
  if (!is_started) is_started = pthread_create(&thread, NULL, abort_later, NULL) == 0;
  return 1;
}

EXPORT_DETECTOR("aborts-later", test, NULL)
