/* Detectors that want up to 10^5 queries at once.
 *   rows, arrays, small-arrays: report every query. The time of impact is the fractional part of a
 *     weighted mean of the query's coordinates. Their names say in which layout they read the
 *     coordinates. `rows` says that its kernels have run for 10^5 seconds; `arrays` says that its
 *     computing time is unknown. `small-arrays` wants 7 queries at once.
 *   counts, counts-50: answer every query with an error code, which is minus the number of queries in
 *     the call. They crash if x[0] > 0.9, and hang if x[0] < -0.9. `counts-50` wants 50 queries at once.
 *   wearing: crashes at the 5000th query of its process, whatever the query is. */
#include <math.h>
#include <signal.h>
#include <stddef.h>

#include "ccd/nearmiss_subject.h"

#define ANY_KIND \
  (NEARMISS_VERTEX_TRIANGLE + NEARMISS_EDGE_EDGE + NEARMISS_VERTEX_VERTEX + NEARMISS_VERTEX_EDGE)

/* In x, the same coordinate of two consecutive queries is `of_query` numbers apart, and two consecutive
 * coordinates of a query are `of_coordinate` apart. */
static void give_means(int kind, size_t n, const double* x, size_t of_query, size_t of_coordinate,
                       int* answer, double* toi) {
  const size_t size = kind == NEARMISS_VERTEX_VERTEX ? 12 : kind == NEARMISS_VERTEX_EDGE ? 18 : 24;
  for (size_t i = 0; i < n; ++i) {
    double sum = 0;
    for (size_t k = 0; k < size; ++k) sum += (double)(k + 1) * x[of_query * i + of_coordinate * k];
    answer[i] = NEARMISS_COLLISION;
    const double mean = sum / (double)(size * (size + 1) / 2);
    toi[i] = mean - floor(mean);
  }
}

static void decide_rows(void* state, int kind, size_t n, const double* x, const double* h, int* answer,
                        double* toi) {
  (void)state, (void)h;
  const size_t size = kind == NEARMISS_VERTEX_VERTEX ? 12 : kind == NEARMISS_VERTEX_EDGE ? 18 : 24;
  give_means(kind, n, x, size, 1, answer, toi);
}

static void decide_arrays(void* state, int kind, size_t n, const double* x, const double* h, int* answer,
                          double* toi) {
  (void)state, (void)h;
  give_means(kind, n, x, 1, n, answer, toi);
}

static void count(void* state, int kind, size_t n, const double* x, const double* h, int* answer,
                  double* toi) {
  (void)state, (void)kind, (void)h, (void)toi;
  for (size_t i = 0; i < n; ++i) {
    if (x[24 * i] > 0.9) raise(SIGSEGV);
    while (x[24 * i] < -0.9) {
    }
    answer[i] = -(int)n;
  }
}

static void wear_out(void* state, int kind, size_t n, const double* x, const double* h, int* answer,
                     double* toi) {
  static size_t done;
  (void)state, (void)kind, (void)x, (void)h, (void)toi;
  for (size_t i = 0; i < n; ++i) {
    if (++done == 5000) raise(SIGSEGV);
    answer[i] = NEARMISS_NO_COLLISION;
  }
}

static double forever(void* state) { return (void)state, 1e5; }
static double unknown(void* state) { return (void)state, NAN; }

#define DETECTOR(...) \
  { .interface_version = NEARMISS_INTERFACE, .kinds = ANY_KIND, __VA_ARGS__ }
#define TIMED .time_sort = NEARMISS_TIME_ESTIMATE
#define ARRAYS TIMED, .decide = decide_arrays, .layout = NEARMISS_ARRAYS

static const nearmiss_subject detectors[] = {
    DETECTOR(.name = "rows", .batch = 100000, TIMED, .decide = decide_rows, .seconds_of_kernels = forever),
    DETECTOR(.name = "arrays", .batch = 100000, ARRAYS, .seconds_of_kernels = unknown),
    DETECTOR(.name = "small-arrays", .batch = 7, ARRAYS),
    DETECTOR(.name = "counts", .batch = 100000, .decide = count),
    DETECTOR(.name = "counts-50", .batch = 50, .decide = count),
    DETECTOR(.name = "wearing", .batch = 100000, .decide = wear_out)};

const nearmiss_subject* nearmiss_get_subject(size_t index) {
  return index < sizeof detectors / sizeof detectors[0] ? &detectors[index] : NULL;
}
