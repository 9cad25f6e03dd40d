// The two kinds of queries.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace nearmiss {

/// Which primitives a query has.
enum class Kind : std::uint8_t {
  vertex_triangle,  ///< x0 is the vertex, x1 x2 x3 the triangle
  edge_edge,        ///< x0x1 and x2x3 are the edges
};

/// Both kinds.
inline constexpr std::array kinds{Kind::vertex_triangle, Kind::edge_edge};

/// "vt" or "ee": the name on the command line, in files and in reports.
constexpr std::string_view short_name(Kind kind) { return kind == Kind::vertex_triangle ? "vt" : "ee"; }

/// The vertices of one primitive are x[0 .. split), those of the other x[split .. 4).
constexpr int split(Kind kind) { return kind == Kind::vertex_triangle ? 1 : 2; }

}  // namespace nearmiss
