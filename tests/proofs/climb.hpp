// Random search and hill climbing for the problem that comes nearest to a bound.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "fuzz/random.hpp"
#include "fuzz/subjects/ladder/mpfr_float.hpp"

namespace nearmiss::proofs {

/// The effort and the seed of a search.
struct ClimbEffort {
  int rounds;
  /// The number of steps in each round. Before these steps, a round makes steps / 4 random draws.
  int steps;
  std::uint64_t seed = 1;
};

template <class P>
struct Climbed {
  double value;
  P problem;
};

/// The largest value(problem) found, and its problem. `draw(random)` makes a problem, and `change(random,
/// problem)` makes another problem near it.
template <class Draw, class Change, class Value>
auto highest(const ClimbEffort& climb, const Draw& draw, const Change& change, const Value& value) {
  std::optional<Climbed<decltype(draw(std::declval<Random&>()))>> highest;
  for (int round = 0; round < climb.rounds; ++round) {
    Random random(climb.seed, 0, static_cast<std::uint64_t>(round));
    auto best = draw(random);
    double top = value(best);
    for (int i = 0; i < climb.steps + climb.steps / 4; ++i) {
      const auto next = i < climb.steps / 4 ? draw(random) : change(random, best);
      const double found = value(next);
      if (found < top) continue;
      top = found;
      best = next;
    }
    if (!highest || top > highest->value) highest = {top, best};
  }
  return highest.value();
}

/// x, rounded to the thread's precision.
inline double snapped(double x) { return static_cast<double>(MpfrFloat(x)); }

inline double roundoff(int bits) { return std::ldexp(1.0, -bits); }

/// A random number in [-size, size]: any number of this interval, a number near 0, 0 itself, or an end of the
/// interval.
inline double draw_number(Random& random, double size) {
  switch (random.integer(0, 9)) {
    case 0:
      return 0;
    case 1:
      return random.one_in(2) ? size : -size;
    case 2:
      return random.uniform(-size, size) * random.log_uniform(1e-6, 1);
    default:
      return random.uniform(-size, size);
  }
}

/// A random number near x, or a new random number in [-size, size].
inline double changed_number(Random& random, double x, double size, int bits) {
  switch (random.integer(0, 5)) {
    case 0:
      return draw_number(random, size);
    case 1:
      return -x;
    case 2:
      return x + random.uniform(-1, 1) * random.log_uniform(roundoff(bits), size);
    default:
      return x * (1 + random.uniform(-1, 1) * random.log_uniform(roundoff(bits), 1));
  }
}

}  // namespace nearmiss::proofs
