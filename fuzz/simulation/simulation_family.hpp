// Families of what simulations ask.
#pragma once

#include <string_view>

#include "fuzz/families/families.hpp"
#include "fuzz/stop.hpp"

namespace nearmiss {

/// Finds a family by its name, as find_family does, or makes the family of a simulation: sim:SCENE, or a name
/// with options (simulation_name.hpp), which may have a ~SEPARATION behind it. For the latter, simulates the
/// scene with the oracle as its CCD, and keeps a sample of the pairs that it is asked about. Each query is one
/// of these pairs, unchanged. Throws Error, and Stopped if the stop is due before the simulation ends.
Family find_any_family(std::string_view name, const Stop& stop = Stop::never(),
                       std::span<const Family> known = all_families());

}  // namespace nearmiss
