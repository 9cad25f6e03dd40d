// Measures how much slack the constants of the paper have.
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

/// The measurements, and the time for each.
struct TightnessPlan {
  std::vector<std::string> names;  ///< some of `tightness_names(among_vertices)`
  std::vector<Family> families;    ///< sources of queries in addition to directed search
  bool among_vertices = false;     ///< whether the search is among two vertices, and a vertex and an edge
  std::chrono::duration<double> time{};  ///< time for each name
  std::uint64_t seed = 1;
  int jobs = 1;
};

/// The names of the tolerances, and of the groups of accepting tests: "proximity", "vertex-edge",
/// "vertex-vertex". Among vertices, only those of Algorithms 1 and 2.
std::vector<std::string> tightness_names(bool among_vertices = false);

/// Receives the result so far for a name; `done` is set when the time for this name is over.
using TightnessSink = std::function<void(const Extreme&, bool done)>;

/// For a tolerance, half of the queries are drawn from all families, and directed search finds the other
/// half: collisions that need most of the tolerance. Each collision gives a factor. If the tolerance is
/// multiplied by a smaller one (a larger one if the tolerance excludes degenerate primitives), the subject
/// misses the collision. For a group of tests, false positives are measured instead: those of wang without
/// the tests that accept from farther away. Throws Error for an unknown name.
void measure_tightness(const TightnessPlan& plan, const TightnessSink& sink, const std::atomic<bool>& stop);

}  // namespace nearmiss
