// The families that a trial of a program's own functions asks.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/families/families.hpp"
#include "fuzz/trial/trial.hpp"

namespace nearmiss {

/// The families of these names, or of the groups `all` and `vertices`, of which these kinds are asked.
/// Without names, all of pairs of meshes and of vertices and edges that have such kinds, in the order of a
/// campaign. `separation` is "drawn" or a positive number, for families that have no separations of their
/// own; if it is "", families of vertices and edges draw them, and the others ask for contact. Throws Error.
std::vector<Family> families_asked(const std::vector<std::string>& names, std::span<const Kind> asked,
                                   std::string_view separation = {});

/// Throws Error if one of the subjects is asked none of the families' queries.
void expect_all_asked(const Subjects& subjects, std::span<const Family> families);

}  // namespace nearmiss
