// Facts that may explain a failure: when the vertices of a query are coplanar, and when its primitives first
// touch.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// Facts about a query that often make the difference for a CCD. Exact arithmetic determines them.
struct Explanation {
  enum class Contact : std::uint8_t {
    none,    ///< the primitives do not touch, or do not come within the separation
    start,   ///< at t = 0
    early,   ///< at 0 < t <= 2^-40
    inside,  ///< at 2^-40 < t < 1
    end,     ///< at t = 1
  };

  /// The number of different times in [0, 1] at which the four vertices are coplanar; -1 if the vertices are
  /// always coplanar, and nothing for kinds with fewer than four vertices.
  std::optional<int> roots;
  /// Whether and when the primitives first touch or, for h > 0, first come within the separation.
  Contact contact{};
  bool is_approach = false;  ///< whether the query has a separation
  /// Whether there is a contact that root parity cannot see, because it counts an even number of roots.
  bool unseen_by_parity = false;

  bool operator==(const Explanation&) const = default;
};

Explanation explain(const Query& query);

/// The facts as a text such as "contact inside the step; the vertices are coplanar once".
std::string to_text(const Explanation& explanation);

}  // namespace nearmiss
