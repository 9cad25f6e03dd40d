/* A plug-in that was compiled with version 2 of the interface: its structure ends with distance_bound. What
 * stands behind it in memory would be wrong fields of version 3. Reports all queries; claims the bound 0.125.
 */
#include <stddef.h>

typedef struct {
  int interface_version;
  const char *name, *version, *about;
  int kinds, bits, time_sort, takes_separation;
  size_t batch;
  struct {
    int apart_at_start, one_root;
    double apart_by, grid, shortest, longest;
  } contract;
  void* (*open)(const char*, char*, size_t);
  void (*close)(void*);
  void (*decide)(void*, int, size_t, const double*, const double*, int*, double*);
  double (*distance_bound)(void*, int, const double*);
} subject_of_version_2;

static void decide(void* state, int kind, size_t n, const double* x, const double* h, int* answer,
                   double* toi) {
  (void)state, (void)kind, (void)x, (void)h, (void)toi;
  for (size_t i = 0; i < n; ++i) answer[i] = 1;
}

static double bound(void* state, int kind, const double* x) {
  (void)state, (void)kind, (void)x;
  return 0.125;
}

const subject_of_version_2* nearmiss_get_subject(size_t index) {
  static const struct {
    subject_of_version_2 subject;
    size_t behind_it[8];
  } detector = {{.interface_version = 2,
                 .name = "version-2",
                 .kinds = 3,
                 .takes_separation = 1,
                 .decide = decide,
                 .distance_bound = bound},
                {12345, 12345, 12345, 12345, 12345, 12345, 12345, 12345}};
  return index == 0 ? &detector.subject : NULL;
}
