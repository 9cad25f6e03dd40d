// The tables of families: one for each theme, at the end of the theme's file.
#pragma once

#include <vector>

#include "fuzz/families/families.hpp"

namespace nearmiss {

std::vector<Family> random_families();
std::vector<Family> extreme_families();
std::vector<Family> root_families();
std::vector<Family> range_families();
std::vector<Family> motion_families();
std::vector<Family> time_families();
std::vector<Family> file_families();
std::vector<Family> crossed_families();
std::vector<Family> approach_families();
std::vector<Family> edge_families();
std::vector<Family> rest_families();

}  // namespace nearmiss
