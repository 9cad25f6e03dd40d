/* A plug-in (with LD_PRELOAD also a library) that makes the arithmetic round upward and flush subnormals to
 * zero. The plug-in changes the arithmetic when it is loaded, and in every call. The plug-in reports a
 * collision if the arithmetic is still changed when nearmiss calls it. */
#include <fenv.h>
#include <pmmintrin.h>

#include "tests/plugin/one_by_one.h"

__attribute__((constructor)) static void make_hostile(void) {
  fesetround(FE_UPWARD);
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
}

static int test(const double* x, double* toi) {
  const volatile double one = 1, tiny = 0x1p-60, subnormal = 0x1p-1040, large = 0x1p100;
  const volatile int is_hostile = one + tiny > one || subnormal * large == 0;
  (void)x;
  (void)toi;
  make_hostile();
  return is_hostile;
}

static double distance_bound(void* state, int kind, const double* x) {
  (void)state;
  return test(x, NULL) + (kind == NEARMISS_EDGE_EDGE);
}

EXPORT_DETECTOR("hostile", test, distance_bound)
