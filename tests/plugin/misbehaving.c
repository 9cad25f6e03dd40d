/* A subject that reports every query, but misbehaves on one query in N, chosen by the bits of the
 * coordinates. The environment variable NEARMISS_ONE_IN gives N; the default is 100. */
#define _GNU_SOURCE
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "tests/plugin/one_by_one.h"

static int is_chosen(const double* x) {
  const char* const text = getenv("NEARMISS_ONE_IN");
  const uint64_t one_in = text != NULL ? strtoull(text, NULL, 10) : 100;
  uint64_t hash = 0;
  for (int i = 0; i < 24; ++i) {
    uint64_t bits;
    memcpy(&bits, &x[i], sizeof bits);
    hash = (hash ^ bits) * 0x9e3779b97f4a7c15U;
    hash ^= hash >> 29;
  }
  return hash % one_in == 0;
}

static int misbehave(void) {
#if defined(CRASH)
  fprintf(stderr, "first words%5000s\n\033[31mlast words\n", "");
  return raise(SIGSEGV);
#elif defined(LEAVE)
  exit(3);
#elif defined(HANG)
  for (volatile int i = 0; i >= 0; i = 0) {
  }
  return 1;
#elif defined(SLEEP)
  sigset_t none;
  sigemptyset(&none);
  while (sigsuspend(&none) != 0) {
  }
  return 1;
#elif defined(EAT)
  while (memset(malloc(1 << 20), 1, 1 << 20) != NULL) {
  }
  return 1;
#elif defined(EAT_FILE)
  static char block[1 << 20];
  const int file = memfd_create("eaten", 0);
  while (write(file, block, sizeof block) > 0) {
  }
  close(file);
  return 1;
#elif defined(EAT_IN_CHILDREN)
  for (int i = 0; i < 16; ++i) {
    if (fork() != 0) continue;
    for (void* block = malloc(1 << 20); block != NULL; block = malloc(1 << 20)) memset(block, 1, 1 << 20);
    while (1) pause();
  }
  return 1;
#elif defined(FAIL)
  return -7;
#else
  puts("to stdout");
  fputs("to stderr", stderr);
  fflush(stdout);
  return 1;
#endif
}

#if defined(WHILE_LOADED)
__attribute__((constructor)) static void begin(void) { misbehave(); }
#endif

static int test(const double* x, double* toi) {
  (void)toi;
  return is_chosen(x) ? misbehave() : 1;
}

EXPORT_DETECTOR("misbehaving", test, NULL)
