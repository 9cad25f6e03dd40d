/* A plug-in whose answers come from the library beside it. */
#include <stddef.h>

#include "ccd/nearmiss_subject.h"

int beside(void);

static int answer(const double* x, double* toi) {
  (void)x;
  (void)toi;
  return beside();
}

static const nearmiss_subject subject = {NEARMISS_SUBJECT_ABI, "finds-beside", NULL, answer, answer, NULL};

const nearmiss_subject* nearmiss_get_subject(void) { return &subject; }
