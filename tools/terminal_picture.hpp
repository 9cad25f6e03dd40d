// A query drawn with characters.
#pragma once

#include <string>

#include "ccd/query/query.hpp"

namespace nearmiss::tools {

/// Lines of text that show the query in parallel projection along the axis along which it is the shortest: both primitives at
/// a time, the first with 'o' and the second with '#', their vertices with their numbers, and the vertices' paths with '.'.
std::string terminal_picture(const Query& query, double time);

}  // namespace nearmiss::tools
