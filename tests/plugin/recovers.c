/* A subject that asks for more memory than allowed, goes on without it, and reports the query. Its process crashes at
 * the next query. */
#include <signal.h>
#include <stddef.h>
#include <stdlib.h>

#include "tests/plugin/one_by_one.h"

static int test(const double* x, double* toi) {
  static int calls = 0;
  (void)x;
  (void)toi;
  if (++calls == 2) return raise(SIGSEGV);
  void* volatile const refused = malloc((size_t)1 << 40);
  free(refused);
  return 1;
}

EXPORT_DETECTOR("recovers", test, NULL)
