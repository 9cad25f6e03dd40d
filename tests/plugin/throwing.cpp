// A subject whose behaviour depends on the first coordinate of a query. It throws an exception if the
// coordinate is above 0.9, throws an exception without text if the coordinate is 0.5, and crashes if it is
// -2. All other queries get the answer ANSWER, which is a macro. With WHILE_LOADED, the subject throws an
// exception as soon as a program loads it.
#include <csignal>
#include <exception>
#include <stdexcept>
#include <string>

#include "tests/plugin/one_by_one.h"

#ifndef ANSWER
#define ANSWER 0
#endif

namespace {

struct Silent : std::exception {
  [[nodiscard]] const char* what() const noexcept override { return nullptr; }
};

int answer(const double* x, double* /*toi*/) {
  if (x[0] > 0.9) throw std::runtime_error("no root in [" + std::to_string(x[0]) + ", 1]\n\x1b[31m");
  if (x[0] == 0.5) throw Silent();
  if (x[0] == -2) std::raise(SIGSEGV);
  return ANSWER;
}

const char* name() {
#ifdef WHILE_LOADED
  throw std::runtime_error("no licence");
#endif
  return "throwing";
}

}  // namespace

EXPORT_DETECTOR(name(), answer, nullptr)
