// A query drawn with characters.
#pragma once

#include <string>

#include "ccd/query/query.hpp"

namespace nearmiss::tools {

/// Lines of text that show the query at a time, in parallel projection along the axis of its smallest extent:
/// the first primitive with 'o', the second with '#', vertices with their numbers, and the paths of the
/// vertices with '.'.
std::string terminal_picture(const Query& query, double time);

}  // namespace nearmiss::tools
