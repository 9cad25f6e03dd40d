// Measures the slack of the tolerances in Wang's paper.
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

/// The plan of a measurement: what is measured, among which queries, and for how long.
struct TightnessPlan {
  std::vector<std::string> names;        ///< some of `tightness_names(among_vertices)`
  std::vector<Family> families;          ///< families that supply queries in addition to directed search
  bool among_vertices = false;           ///< whether to search among queries of the kinds vv and ve
  std::chrono::duration<double> time{};  ///< time for each name
  std::uint64_t seed = 1;
  int jobs = 1;
};

/// The names of the tolerances, and of the groups of accepting tests: "proximity", "vertex-edge",
/// "vertex-vertex". With `among_vertices`, returns only the names of the tolerances and tests that Algorithms
/// 1 and 2 use.
std::vector<std::string> tightness_names(bool among_vertices = false);

/// Receives the result for a name, as far as the result is known. `done` is true when the time for this name
/// is over.
using TightnessSink = std::function<void(const Extreme&, bool done)>;

/// Measures each tolerance and each group of tests. Half of the queries come from the plan's families, and
/// directed search gives the other half. For a tolerance, the search looks for collisions that the subject
/// would miss if the tolerance were slightly tighter. Each collision gives a factor: the subject misses the
/// collision if the tolerance is multiplied by less than this factor. (If the tolerance excludes degenerate
/// primitives, the subject misses the collision if the tolerance is multiplied by more than this factor.) For
/// a group of tests, the search looks for false positives at large distances. The function runs wang without
/// the groups that accept pairs at larger distances than this group, and measures the distances of the false
/// positives. Throws Error for an unknown name.
void measure_tightness(const TightnessPlan& plan, const TightnessSink& sink, const std::atomic<bool>& stop);

}  // namespace nearmiss
