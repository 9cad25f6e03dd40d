// Enclosures: two doubles between which an exact value lies.
#pragma once

#include <cmath>

namespace nearmiss {

/// lo <= the exact value <= hi.
struct Enclosure {
  double lo = 0;
  double hi = 0;

  bool operator==(const Enclosure&) const = default;
};

/// An enclosure of a time.
struct KnownTime {
  Enclosure time;
  bool is_between = false;  ///< whether the time is certainly neither end of the enclosure

  /// Whether the enclosure is at most `width` wide, or as narrow as doubles allow.
  [[nodiscard]] bool is_known_to(double width) const {
    return time.hi - time.lo <= width || (is_between && std::nextafter(time.lo, 2.0) == time.hi);
  }
};

}  // namespace nearmiss
