/* A program that records queries as a simulation would: recording COUNT [open|kill|wait|float|tmax
 * T|kept|threads|fork|lines]. With `lines`, each line of stdin is a record: kind, separation, tmax, answer,
 * toi, whether the record is in float, coordinates. */
#include "ccd/nearmiss_record.h"

#include <pthread.h>
#include <signal.h>

static long count;

/* Records query i: a vertex falls through a triangle, from z = 1 to -1. Every tenth answer is "no". */
static void record(long i, double tmax, int flags) {
  double x[24] = {0.25, 0.25, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.25, 0.25, -1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
  const int answer = i % 10 != 0;
  x[0] = x[12] = 0.25 + (double)i * 0x1p-30;
  nearmiss_record(NEARMISS_VERTEX_TRIANGLE, x, 0, tmax, answer, answer ? 0.25 : NAN, flags);
}

static void* record_all(void* first) {
  for (long i = 0; i < count; ++i) record(*(const long*)first + i, 1, 0);
  return NULL;
}

static void record_lines(void) {
  int kind, answer, is_float;
  double h, tmax, toi, x[24];
  float y[24];
  while (scanf("%d %la %la %d %la %d", &kind, &h, &tmax, &answer, &toi, &is_float) == 6) {
    for (int i = 0; i < nearmiss_record_size(kind); ++i) {
      if (scanf("%la", &x[i]) != 1) exit(1);
      y[i] = (float)x[i];
    }
    if (is_float)
      nearmiss_record_float(kind, y, (float)h, (float)tmax, answer, (float)toi, 0);
    else
      nearmiss_record(kind, x, h, tmax, answer, toi, 0);
  }
}

int main(int argc, char** argv) {
  const char* how = argc > 2 ? argv[2] : "";
  count = argc > 1 ? atol(argv[1]) : 0;
  if (strcmp(how, "open") == 0) {
    (void)nearmiss_record_is_on(); /* makes the file */
  } else if (strcmp(how, "float") == 0) {
    const float x[24] = {0.1F, 0.1F, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.1F, 0.1F, -1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
    nearmiss_record_float(NEARMISS_VERTEX_TRIANGLE, x, 0, 1, NEARMISS_COLLISION, 0.5F, 0);
  } else if (strcmp(how, "lines") == 0) {
    record_lines();
  } else if (strcmp(how, "threads") == 0) {
    pthread_t threads[4];
    long first[4];
    for (int k = 0; k < 4; ++k) {
      first[k] = k * count;
      pthread_create(&threads[k], NULL, record_all, &first[k]);
    }
    for (int k = 0; k < 4; ++k) pthread_join(threads[k], NULL);
  } else if (strcmp(how, "fork") == 0) {
    record(0, 1, 0);
    const long first = fork() == 0 ? 1000 : 2000;
    record_all((void*)&first);
  } else {
    const double tmax = strcmp(how, "tmax") == 0 && argc > 3 ? atof(argv[3]) : 1;
    for (long i = 1; i <= count; ++i) record(i, tmax, strcmp(how, "kept") == 0 && i == 3 ? NEARMISS_KEEP : 0);
    if (strcmp(how, "kill") == 0) raise(SIGKILL);
    if (strcmp(how, "wait") == 0) pause();
  }
  return 0;
}
