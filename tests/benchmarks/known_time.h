/* Arithmetic of known length: a chain of multiply-adds, each with two rounded operations. A multiply-add
 * waits for the result of the previous one. */
#ifndef NEARMISS_KNOWN_TIME_H
#define NEARMISS_KNOWN_TIME_H

static inline int known_time(const double* x, int steps) {
  double sum = x[0];
  for (int i = 0; i < steps; ++i) sum = sum * 0.5 + 1.0;
  return sum == 0.0;
}

#endif
