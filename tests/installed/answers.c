/* Asks an installed nearmiss through its C interface, and compares its answers with those on standard input,
 * which tests/installed/answers.cpp describes. */
#include <math.h>
#include <nearmiss/nearmiss.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static size_t differences = 0;

static void compare(const char* what, const void* found, const void* expected, size_t size, size_t count) {
  for (size_t i = 0; i < count; ++i)
    if (memcmp((const char*)found + i * size, (const char*)expected + i * size, size) != 0 &&
        ++differences < 10)
      fprintf(stderr, "%s of query %zu of a block differs\n", what, i);
}

static void* space(size_t count, size_t size) {
  void* const made = malloc(count * size);
  if (made == NULL) exit(2);
  return made;
}

static void* numbers(size_t count, size_t size) {
  void* const read = space(count, size);
  if (fread(read, size, count, stdin) != count) {
    fprintf(stderr, "the input ends within a block\n");
    exit(2);
  }
  return read;
}

static void expect(int status, int expected) {
  if (status != expected && ++differences < 10) fprintf(stderr, "status: %s\n", nearmiss_message(status));
}

/* A certificate is cut off as by snprintf(), and has the length that the first call gives. */
static void check_certificate(void) {
  const double touching[24] = {0};
  const nearmiss_queries query = nearmiss_packed(NEARMISS_VERTEX_TRIANGLE, 1, touching);
  const int what = NEARMISS_PROVE_DECISION;
  char start[8] = "#######";
  size_t length = 0, again = 0;
  expect(nearmiss_certificate(&query, 0, what, NULL, 0, &length), NEARMISS_OK);
  char* const text = space(length + 1, 1);
  expect(nearmiss_certificate(&query, 0, what, text, length + 1, &again), NEARMISS_OK);
  expect(nearmiss_certificate(&query, 0, what, start, 4, &again), NEARMISS_OK);
  if (again != length || strlen(text) != length || strstr(text, "\"claim\":\"meets\"") == NULL) ++differences;
  if (strncmp(start, text, 3) != 0 || memcmp(start + 3, "\0###", 5) != 0) ++differences;
  expect(nearmiss_certificate(&query, 1, what, text, length + 1, &again), NEARMISS_BAD_ARGUMENT);
  free(text);
}

int main(void) {
  int32_t head[3]; /* kind; number of queries; 1 if their times and distances follow */
  size_t asked = 0;
  while (fread(head, sizeof head, 1, stdin) == 1) {
    const size_t n = (size_t)head[1];
    asked += n;
    double* const x = numbers(24 * n, sizeof *x);
    double* const h = numbers(n, sizeof *h);
    int8_t* const collides = numbers(n, 1);
    int8_t* const wang = numbers(n, 1);
    double* const bound = numbers(n, sizeof *bound);
    int8_t* const answers = space(n, 1);
    double* const lo = space(n, sizeof *lo);
    double* const hi = space(n, sizeof *hi);

    nearmiss_queries queries = nearmiss_packed(head[0], n, x);
    expect(nearmiss_wang(&queries, answers), NEARMISS_OK);
    compare("wang", answers, wang, 1, n);
    expect(nearmiss_wang_bound(&queries, lo), NEARMISS_OK);
    compare("the bound of wang", lo, bound, sizeof *lo, n);
    queries.separation = h;
    queries.separation_stride = sizeof *h;
    expect(nearmiss_collides(&queries, answers, NULL), NEARMISS_OK);
    compare("the exact answer", answers, collides, 1, n);
    if (head[2]) {
      double* const times = numbers(2 * n, sizeof *times);
      double* const distances = numbers(2 * n, sizeof *distances);
      expect(nearmiss_earliest_time(&queries, 0, lo, hi), NEARMISS_OK);
      compare("the earliest time", lo, times, sizeof *lo, n);
      compare("the earliest time's upper bound", hi, times + n, sizeof *lo, n);
      expect(nearmiss_time_of_impact(&queries, 1, answers, hi), NEARMISS_OK);
      compare("the answer with a time of impact", answers, collides, 1, n);
      compare("the time of impact", hi, times, sizeof *lo, n);
      expect(nearmiss_smallest_distance(&queries, 1e-3, lo, hi), NEARMISS_OK);
      compare("the smallest distance", lo, distances, sizeof *lo, n);
      compare("the smallest distance's upper bound", hi, distances + n, sizeof *lo, n);
      free(times);
      free(distances);
    }
    free(x), free(h), free(collides), free(wang), free(bound), free(answers), free(lo), free(hi);
  }

  /* Errors are returned as values. */
  double point[24] = {0};
  int8_t answer = 7;
  double time = 7;
  nearmiss_queries one = nearmiss_packed(NEARMISS_EDGE_EDGE, 1, point);
  expect(nearmiss_collides(&one, &answer, NULL), NEARMISS_OK);
  if (answer != NEARMISS_COLLISION) ++differences;
  point[7] = HUGE_VAL;
  expect(nearmiss_collides(&one, &answer, NULL), NEARMISS_NOT_FINITE);
  if (answer != NEARMISS_NO_ANSWER) ++differences;
  expect(nearmiss_time_of_impact(&one, 1, &answer, &time), NEARMISS_NOT_FINITE);
  if (time != 0) ++differences;
  one.kind = 3;
  answer = 7;
  expect(nearmiss_wang(&one, &answer), NEARMISS_BAD_ARGUMENT);
  expect(nearmiss_collides(NULL, &answer, NULL), NEARMISS_BAD_ARGUMENT);
  if (answer != 7) ++differences;

  check_certificate();
  printf("C, nearmiss %s: %zu queries, %zu differences\n", nearmiss_version(), asked, differences);
  return differences == 0 ? 0 : 1;
}
