/* A plug-in compiled for version 2 or 3 of the interface (VERSION), whose structure has fewer fields than
 * that of later versions. If nearmiss read the fields of later versions, it would read the memory after the
 * structure, which holds wrong values. The plug-in reports all queries. It claims the bound 0.125; in version
 * 3, it claims this bound plus the separation. */
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
#if VERSION >= 3
  int separation_kinds;
  double (*distance_bound_within)(void*, int, const double*, double);
#endif
} older_subject;

static void decide(void* state, int kind, size_t n, const double* x, const double* h, int* answer,
                   double* toi) {
  (void)state, (void)kind, (void)x, (void)h, (void)toi;
  for (size_t i = 0; i < n; ++i) answer[i] = 1;
}

#if VERSION >= 3
static double bound_within(void* state, int kind, const double* x, double h) {
  (void)state, (void)kind, (void)x;
  return 0.125 + h;
}
#else
static double bound(void* state, int kind, const double* x) {
  (void)state, (void)kind, (void)x;
  return 0.125;
}
#endif

const older_subject* nearmiss_get_subject(size_t index) {
  static const struct {
    older_subject subject;
    size_t behind_it[8];
  } detector = {{.interface_version = VERSION,
                 .name = "older-version",
                 .kinds = 3,
                 .decide = decide,
#if VERSION >= 3
                 .separation_kinds = 3,
                 .distance_bound_within = bound_within
#else
                 .takes_separation = 1,
                 .distance_bound = bound
#endif
                },
                {12345, 12345, 12345, 12345, 12345, 12345, 12345, 12345}};
  return index == 0 ? &detector.subject : NULL;
}
