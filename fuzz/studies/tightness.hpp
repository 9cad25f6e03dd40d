// How tight are the constants of the paper?
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "fuzz/families/families.hpp"
#include "reports/statistics/extreme.hpp"

namespace nearmiss {

/// What is measured, with how much work.
struct TightnessPlan {
  std::vector<std::string> names;        ///< of tolerances, and of tests: see `tightness_names`
  std::vector<Family> families;          ///< to draw from, beside the directed search
  std::chrono::duration<double> time{};  ///< for each name
  std::uint64_t seed = 1;
  int jobs = 1;
};

/// The tolerances, and "proximity", "vertex-edge" and "vertex-vertex": the tests that accept.
std::vector<std::string> tightness_names();

/// Takes the result of a name: as it is so far, or when its time is over.
using TightnessSink = std::function<void(const Extreme&, bool done)>;

/// For a tolerance, half of the time collisions are drawn from all families, half directed search looks for
/// those that need the most of it: each has a factor on this tolerance below (above) which it is missed. For
/// tests, likewise with false positives of wang without what accepts from farther away. Throws Error for an
/// unknown name.
void measure_tightness(const TightnessPlan& plan, const TightnessSink& sink, const std::atomic<bool>& stop);

}  // namespace nearmiss
