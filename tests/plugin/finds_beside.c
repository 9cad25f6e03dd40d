/* A plug-in whose answers come from a library in its folder (beside.c). */
#include <stddef.h>

#include "tests/plugin/one_by_one.h"

int beside(void);

static int answer(const double* x, double* toi) {
  (void)x;
  (void)toi;
  return beside();
}

EXPORT_DETECTOR("finds-beside", answer, NULL)
