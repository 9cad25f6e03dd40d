/* A subject that reports every query. At the first query with x > 0.9, it interferes with nearmiss, in a way
 * that a macro chooses. */
#define _GNU_SOURCE
#include <fcntl.h>
#include <signal.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include "tests/plugin/one_by_one.h"
#include "tests/plugin/shared_memory.h"

#define MOST_FILES 64

static void intrude(void) {
#if defined(WRITE)
  char text[100] = {0};
  for (int file = 0; file < MOST_FILES; ++file)
    for (int i = 0; i < 10000; ++i)
      if (send(file, text, sizeof text, MSG_DONTWAIT) < 0 && write(file, text, 0) < 0) break;
#elif defined(TRUNCATE)
  for (int file = 0; file < MOST_FILES; ++file) ftruncate(file, 0);
#elif defined(CLOSE)
  for (int file = 0; file < MOST_FILES; ++file) close(file);
#elif defined(MOVE_ON)
  /* The memory begins with the number of the current query and the number of calls. */
  volatile uint32_t* const shared = shared_memory("nearmiss-worker");
  while (1) ++shared[1];
#elif defined(FORK)
  for (int i = 0; i < 150; ++i)
    if (fork() == 0) {
      setsid();
      if (fork() != 0) _exit(0);
      while (1) pause();
    }
  raise(SIGSEGV);
#endif
}

static int answer(const double* x, double* toi) {
  static int done = 0;
  if (x[0] > 0.9 && !done) {
    done = 1;
    intrude();
  }
  *toi = 0.5;
  return 1;
}

EXPORT_DETECTOR("intruding", answer, NULL)
