// Checks certificates: lines of JSON, each of which proves one claim about two moving primitives.
#pragma once

#include <gmpxx.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace certificates {

/// The claim that a line proves. A vertex that moves from s to e is at (1 - t) s + t e at time t, exactly.
/// dist(t) is the distance of the primitives A and B, which are closed points, segments or triangles, and may
/// be degenerate.
///   apart: dist(t) > h for all t in [from, to]; not strict: dist(t) >= h; open: only for t in [from, to).
///   meets: dist(t) <= h for some t in [from, to]; strict: dist(t) < h.
struct Statement {
  std::string kind;       ///< "vv", "ve", "vt" or "ee"
  std::vector<double> x;  ///< x, y, z of the vertices of A, then of B, at t = 0; then all of them at t = 1
  double h;               ///< the separation, at least 0
  std::string claim;      ///< "apart" or "meets"
  mpq_class from, to;     ///< 0 <= from <= to <= 1
  bool open, strict;
  bool operator==(const Statement&) const = default;
};

inline constexpr std::size_t longest_line = 1 << 19;  ///< in bytes, without the end of the line

struct Refused : std::runtime_error {  ///< the line proves nothing; what() says why
  using std::runtime_error::runtime_error;
};
struct Unreadable : Refused {  ///< the line is no JSON object in ASCII, or is too long
  using Refused::Refused;
};

/// Returns the statement that the line proves, or throws Refused. Compare the statement with your question: a
/// line may prove a true statement about another query or another interval.
Statement check(std::string_view line);

}  // namespace certificates
