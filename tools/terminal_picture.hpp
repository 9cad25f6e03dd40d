// A query drawn with characters.
#pragma once

#include <string>

#include "ccd/query/query.hpp"

namespace nearmiss::tools {

/// Lines of text that show the query at t = `time`, in parallel projection along the coordinate axis in which
/// the query's extent is smallest. 'o' draws the first primitive, '#' the second, digits the vertices, and
/// '.' the paths of the vertices.
std::string terminal_picture(const Query& query, double time);

/// A line for each vertex, "  x0 (0, 0, 0) -> (0, 0, 1)": the vertex's coordinates at t = 0 and, if it moves,
/// at t = 1. The coordinates are exact, unless the line would then be longer than `widest`; "~" marks rounded
/// coordinates. Lines with rounded coordinates have at most 100 columns.
std::string vertex_lines(const Query& query, std::size_t widest = std::string::npos);

}  // namespace nearmiss::tools
