// A subject that throws an exception for a query with x > 0.9, or while it is loaded.
#include <stdexcept>
#include <string>

#include "ccd/nearmiss_subject.h"

namespace {

int answer(const double* x, double* /*toi*/) {
  if (x[0] > 0.9) throw std::runtime_error("no root in [" + std::to_string(x[0]) + ", 1]\n\x1b[31m");
  return 0;
}

const nearmiss_subject subject{NEARMISS_SUBJECT_ABI, "throwing", "1", answer, answer, nullptr};

}  // namespace

extern "C" const nearmiss_subject* nearmiss_get_subject() {
#ifdef WHILE_LOADED
  throw std::runtime_error("no licence");
#endif
  return &subject;
}
