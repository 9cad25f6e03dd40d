/* A plug-in whose answers come from the library beside it. */
#include <stddef.h>

#include "tests/plugin/one_by_one.h"

int beside(void);

static int answer(const double* x, double* toi) {
  (void)x;
  (void)toi;
  return beside();
}

EXPORT_DETECTOR("finds-beside", answer, NULL)
