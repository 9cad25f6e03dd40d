/* Several detectors in one shared object. Each detector does one thing that the interface allows or
 * forbids. */
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ccd/nearmiss_subject.h"

#define ANY_KIND (NEARMISS_VERTEX_TRIANGLE + NEARMISS_EDGE_EDGE)

/* This detector gives the answer that its option says: "answer=0", "answer=1" ... */
static void* open_answer(const char* options, char* message, size_t size) {
  int* const state = malloc(sizeof *state);
  if (state == NULL) return NULL;
  *state = NEARMISS_COLLISION;
  if (options[0] == '\0' || sscanf(options, "answer=%d", state) == 1) return state;
  snprintf(message, size, "expected answer=NUMBER");
  free(state);
  return NULL;
}

static void decide_as_told(void* state, int kind, size_t n, const double* x, const double* h, int* answer,
                           double* toi) {
  (void)kind, (void)x, (void)h, (void)toi;
  for (size_t i = 0; i < n; ++i) answer[i] = *(int*)state;
}

/* Gives x[0] as the time of each collision. */
static void give_time(void* state, int kind, size_t n, const double* x, const double* h, int* answer,
                      double* toi) {
  (void)state, (void)kind, (void)h;
  for (size_t i = 0; i < n; ++i) {
    answer[i] = NEARMISS_COLLISION;
    toi[i] = x[24 * i];
  }
}

/* Reports queries whose coordinates and separations are all floats. */
static void find_floats(void* state, int kind, size_t n, const double* x, const double* h, int* answer,
                        double* toi) {
  (void)state, (void)kind, (void)toi;
  for (size_t i = 0; i < n; ++i) {
    answer[i] = (double)(float)h[i] == h[i] ? NEARMISS_COLLISION : NEARMISS_NO_COLLISION;
    for (size_t k = 0; k < 24; ++k)
      if ((double)(float)x[24 * i + k] != x[24 * i + k]) answer[i] = NEARMISS_NO_COLLISION;
  }
}

/* Answers every query with an error code: minus the number of queries in the call. Crashes if x[0] > 0.9, and
 * writes no answer if x[0] < 0. */
static void decide_batch(void* state, int kind, size_t n, const double* x, const double* h, int* answer,
                         double* toi) {
  (void)state, (void)kind, (void)h, (void)toi;
  for (size_t i = 0; i < n; ++i) {
    if (x[24 * i] > 0.9) raise(SIGSEGV);
    if (x[24 * i] >= 0) answer[i] = -(int)n;
  }
}

static void find_nothing(void* state, int kind, size_t n, const double* x, const double* h, int* answer,
                         double* toi) {
  (void)state, (void)kind, (void)x, (void)h, (void)toi;
  for (size_t i = 0; i < n; ++i) answer[i] = NEARMISS_NO_COLLISION;
}

#define DETECTOR(...) \
  { .interface_version = NEARMISS_INTERFACE, __VA_ARGS__ }

static const nearmiss_subject detectors[] = {
    DETECTOR(.name = "told", .version = "7", .about = "answers what its option says", .kinds = ANY_KIND,
             .open = open_answer, .close = free, .decide = decide_as_told),
    DETECTOR(.name = "edges", .kinds = NEARMISS_EDGE_EDGE, .time_sort = NEARMISS_TIME_LOWER_BOUND,
             .decide = give_time),
    DETECTOR(.name = "floats", .kinds = ANY_KIND, .bits = 24, .takes_separation = 1, .decide = find_floats),
    DETECTOR(.name = "batches", .kinds = ANY_KIND, .batch = 64,
             .contract = {.apart_at_start = 1, .apart_by = 0x1p-20, .grid = 0x1p-10, .longest = 2},
             .decide = decide_batch),
    DETECTOR(.name = "narrow-apart", .kinds = ANY_KIND, .bits = 24, .contract = {.apart_at_start = 1},
             .decide = find_nothing)};

const nearmiss_subject* nearmiss_get_subject(size_t index) {
  return index < sizeof detectors / sizeof detectors[0] ? &detectors[index] : NULL;
}
