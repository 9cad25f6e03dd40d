/* Asks an installed nearmiss through its C interface. */
#include <math.h>
#include <nearmiss/nearmiss.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int differences = 0;

static void expect(int holds, const char* what) {
  if (holds) return;
  ++differences;
  fprintf(stderr, "%s\n", what);
}

static void expect_status(int status, int expected) { expect(status == expected, nearmiss_message(status)); }

/* One vertex falls through a triangle at t = 1/2. Another vertex stays at a distance of at least 1. */
static void check_answers(void) {
  double x[48] = {.25, .25, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, .25, .25, -1, 0, 0, 0, 1, 0, 0, 0, 1, 0,
                  .25, .25, 2, 0, 0, 0, 1, 0, 0, 0, 1, 0, .25, .25, 1,  0, 0, 0, 1, 0, 0, 0, 1, 0};
  nearmiss_queries queries = nearmiss_packed(NEARMISS_VERTEX_TRIANGLE, 2, x);
  int8_t answers[2];
  double lo[2], hi[2];
  expect_status(nearmiss_wang(&queries, answers), NEARMISS_OK);
  expect(answers[0] == NEARMISS_COLLISION && answers[1] == NEARMISS_NO_COLLISION, "wang");
  expect_status(nearmiss_wang_bound(&queries, lo), NEARMISS_OK);
  expect(lo[0] > 0 && lo[0] < 0.1, "the bound of wang");
  expect_status(nearmiss_collides(&queries, answers, NULL), NEARMISS_OK);
  expect(answers[0] == NEARMISS_COLLISION && answers[1] == NEARMISS_NO_COLLISION, "the exact answers");
  expect_status(nearmiss_earliest_time(&queries, 0, lo, hi), NEARMISS_OK);
  expect(lo[0] == 0.5 && hi[0] == 0.5 && lo[1] > 1, "the earliest times");
  expect_status(nearmiss_time_of_impact(&queries, 1, answers, hi), NEARMISS_OK);
  expect(answers[0] == NEARMISS_COLLISION && hi[0] == 0.5, "the time of impact");
  expect_status(nearmiss_smallest_distance(&queries, 1e-3, lo, hi), NEARMISS_OK);
  expect(lo[0] == 0 && lo[1] <= 1 && hi[1] >= 1, "the smallest distances");

  const double h[2] = {0.5, 1};
  queries.separation = h;
  queries.separation_stride = sizeof *h;
  expect_status(nearmiss_earliest_time(&queries, 0, lo, hi), NEARMISS_OK);
  expect(lo[0] == 0.25 && lo[1] == 1, "the earliest times within a separation");

  x[7] = HUGE_VAL;
  expect_status(nearmiss_collides(&queries, answers, NULL), NEARMISS_NOT_FINITE);
  expect(answers[0] == NEARMISS_NO_ANSWER && answers[1] == NEARMISS_COLLISION, "no answer");
  queries.kind = 3;
  expect_status(nearmiss_wang(&queries, answers), NEARMISS_BAD_ARGUMENT);
  expect_status(nearmiss_collides(NULL, answers, NULL), NEARMISS_BAD_ARGUMENT);
}

static void check_certificate(void) {
  const double touching[24] = {0};
  const nearmiss_queries query = nearmiss_packed(NEARMISS_VERTEX_TRIANGLE, 1, touching);
  size_t length = 0, again = 0;
  expect_status(nearmiss_certificate(&query, 0, NEARMISS_PROVE_DECISION, NULL, 0, &length), NEARMISS_OK);
  char* const text = malloc(length + 1);
  if (text == NULL) exit(2);
  expect_status(nearmiss_certificate(&query, 0, NEARMISS_PROVE_DECISION, text, length + 1, &again),
                NEARMISS_OK);
  expect(again == length && strlen(text) == length && strstr(text, "\"claim\":\"meets\"") != NULL, text);
  free(text);
}

int main(void) {
  check_answers();
  check_certificate();
  printf("C, nearmiss %s: %d differences\n", nearmiss_version(), differences);
  return differences == 0 ? 0 : 1;
}
