/* A subject that reports every query, unless a comment below says otherwise. Macros choose what else the
 * subject's process does when it receives a query. */
#define _GNU_SOURCE
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include "tests/plugin/one_by_one.h"
#include "tests/plugin/shared_memory.h"

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

static int compute(void) {
  const double start = computed();
  while (computed() - start < COMPUTES) {
  }
  return 1;
}
#if defined(IN_A_CHILD)
/* A child process computes. The subject's process waits for the answer without wait(2), by sched_yield(2). */
struct shared {
  atomic_int asked, answered;
};

static void serve(struct shared* shared) {
  while (1) {
    while (atomic_load(&shared->asked) == atomic_load(&shared->answered)) sched_yield();
    compute();
    atomic_fetch_add(&shared->answered, 1);
  }
}

static int answer(void) {
  static struct shared* shared = NULL;
  if (shared == NULL) {
    shared = mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (fork() == 0) serve(shared);
  }
  const int asked = atomic_fetch_add(&shared->asked, 1) + 1;
  while (atomic_load(&shared->answered) != asked) sched_yield();
  return 1;
}
#elif defined(AHEAD)
/* When this subject is asked a new query, it decides all queries that it sees in the worker's memory. */
static const double* questions(void) { return shared_memory("nearmiss-questions"); }

static int decided(const double* x) {
  enum { most = 4096 };
  static double known[most][24];
  static int count = 0;
  for (int i = 0; i < count; ++i)
    if (memcmp(known[i], x, sizeof known[i]) == 0) return 1;
  if (count == most) exit(1);
  memcpy(known[count++], x, sizeof known[0]);
  return 0;
}

static int answer_to(const double* x) {
  if (decided(x)) return 1;
  compute();
  const double* const all = questions();
  for (int i = 0; i < QUERIES; ++i)
    if (!decided(all + 24 * i)) compute();
  return 1;
}
#else
static int answer(void) { return compute(); }
#endif
#elif defined(WAITS)
/* Waits a tenth of a millisecond, as if for a device, and reports nothing. */
#define NAME "waits"
static int answer(void) {
  const struct timespec time = {0, 100000};
  nanosleep(&time, NULL);
  return 0;
}
#elif defined(PROCESS_LIMIT)
/* Reports a query if its process has a limit of at least 256 processes, and may not write a core dump. */
#define NAME "process_limit"
static int answer(void) {
  struct rlimit processes, core;
  if (getrlimit(RLIMIT_NPROC, &processes) != 0 || getrlimit(RLIMIT_CORE, &core) != 0 || core.rlim_max != 0)
    return 0;
  return processes.rlim_cur >= 256 && processes.rlim_cur < RLIM_INFINITY &&
         processes.rlim_cur == processes.rlim_max;
}
#elif defined(LOADED_MIB)
/* Takes LOADED_MIB of memory while it is loaded, and USED_MIB for each query. A macro may choose how the
 * subject takes the LOADED_MIB: with mmap(2) (MAPPED); as static data, of which STATIC bytes are written
 * (STATIC); or in a child process, which first reserves addresses without access, and then maps the memory
 * there (CHILD). The default is malloc(3). */
#define NAME "large"
static void* taken(size_t mib) {
  void* const block = malloc(mib << 20);
  if (block == NULL) abort();
  return block;
}

static void* loaded;
__attribute__((constructor)) static void begin(void) {
#if defined(STATIC)
  static char data[(size_t)LOADED_MIB << 20];
  const volatile size_t used = STATIC;
  memset(data, 1, used);
  loaded = data;
#elif defined(CHILD)
  if (fork() == 0) {
    const size_t size = (size_t)LOADED_MIB << 20;
    void* const there = mmap(NULL, size, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    mmap(there, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0);
    sleep(60);
    _exit(0);
  }
  sleep(1);
  loaded = &loaded;
#elif defined(MAPPED)
  loaded = mmap(NULL, (size_t)LOADED_MIB << 20, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (loaded == MAP_FAILED) abort();
#else
  loaded = taken(LOADED_MIB);
#endif
}

static int answer(void) {
  void* volatile const block = taken(USED_MIB);
  free(block);
  return loaded != NULL;
}
#elif defined(RECOVERS)
/* At its first query, asks for more memory than is allowed, and continues when the system refuses. At the
 * second query, the subject's process crashes. */
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
#if defined(AHEAD)
  return answer_to(x);
#else
  return answer();
#endif
}

EXPORT_DETECTOR(NAME, test, NULL)
