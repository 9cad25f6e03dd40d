// One of our own CCDs behind the plug-in interface, in one mode of the processor. ROUNDING is the rounding
// mode; with FLUSH, subnormal results and operands become zero. Each test sets the mode and restores the
// caller's.
#include <algorithm>
#include <cfenv>
#include <exception>

#ifdef FLUSH
#include <pmmintrin.h>
#endif

#include "ccd/nearmiss_subject.h"
#include "fuzz/studies/environments/on_trial.hpp"

namespace {

using namespace nearmiss;

class Mode {
 public:
  Mode() {
    std::fegetenv(&callers_);
    std::fesetround(ROUNDING);
#ifdef FLUSH
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
#endif
  }
  ~Mode() { std::fesetenv(&callers_); }
  Mode(const Mode&) = delete;
  Mode& operator=(const Mode&) = delete;

 private:
  std::fenv_t callers_{};
};

Query query_of(Kind kind, const double* x) {
  Query query;
  query.kind = kind;
  std::copy_n(x, query.x.size(), query.x.begin());
  return query;
}

template <Kind kind>
int test(const double* x, double* /*toi*/) {
  const Query query = query_of(kind, x);
  try {
    const Mode mode;
    return environments::collides(query) ? 1 : 0;
  } catch (const std::exception&) {
    return -1;
  }
}

double distance_bound(const double* x, int is_edge_edge) {
  return environments::distance_bound(
      query_of(is_edge_edge != 0 ? Kind::edge_edge : Kind::vertex_triangle, x));
}

constexpr nearmiss_subject subject{NEARMISS_SUBJECT_ABI,  NAME,          "1", test<Kind::vertex_triangle>,
                                   test<Kind::edge_edge>, distance_bound};

}  // namespace

const nearmiss_subject* nearmiss_get_subject() { return &subject; }
