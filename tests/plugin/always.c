/* A complete plug-in: answers every query with the fixed return value that it was compiled with. */
#include <stddef.h>

#include "ccd/nearmiss_subject.h"

#ifndef ANSWER
#define ANSWER 1
#endif
#ifndef ABI
#define ABI NEARMISS_SUBJECT_ABI
#endif

static int answer(const double* x, double* toi) {
  (void)x;
  if (ANSWER == 1) *toi = 0.5;
  return ANSWER;
}

static const nearmiss_subject subject = {ABI, "always", "1.0", answer, answer, NULL};

const nearmiss_subject* nearmiss_get_subject(void) { return &subject; }
