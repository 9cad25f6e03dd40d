// One of our own CCDs as a plug-in that runs in one mode of the processor. The macro ROUNDING is the rounding
// mode. If the macro FLUSH is defined, subnormal results and operands become zero. Each call of the plug-in
// sets this mode first, and restores the caller's mode at its end.
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

int test(const Query& query) {
  try {
    const Mode mode;
    return environments::collides(query) ? NEARMISS_COLLISION : NEARMISS_NO_COLLISION;
  } catch (const std::exception&) {
    return -1;
  }
}

void decide(void* /*state*/, int kind, std::size_t n, const double* x, const double* /*h*/, int* answer,
            double* /*toi*/) {
  for (std::size_t i = 0; i < n; ++i) answer[i] = test(query_of(*kind_of_bit(kind), x + 24 * i));
}

double distance_bound(void* /*state*/, int kind, const double* x) {
  return environments::distance_bound(query_of(*kind_of_bit(kind), x));
}

constexpr nearmiss_subject subject = [] {
  nearmiss_subject own{};
  own.interface_version = NEARMISS_INTERFACE;
  own.name = NAME;
  own.version = "1";
  own.about = "one of nearmiss's own CCDs, in a mode of the processor";
  own.kinds = NEARMISS_VERTEX_TRIANGLE | NEARMISS_EDGE_EDGE;
  own.decide = decide;
  own.distance_bound = distance_bound;
  return own;
}();

}  // namespace

const nearmiss_subject* nearmiss_get_subject(std::size_t index) { return index == 0 ? &subject : nullptr; }
