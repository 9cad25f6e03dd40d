// A number known to lie between two doubles.
#pragma once

namespace nearmiss {

/// lo <= the exact value <= hi.
struct Enclosure {
  double lo = 0;
  double hi = 0;

  bool operator==(const Enclosure&) const = default;
};

/// What is known about a time.
struct KnownTime {
  Enclosure time;
  bool is_between = false;  ///< whether the time is certainly neither end of the enclosure
};

}  // namespace nearmiss
