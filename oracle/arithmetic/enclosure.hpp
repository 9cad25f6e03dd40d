// A number known to lie between two doubles.
#pragma once

namespace nearmiss {

/// lo <= the exact value <= hi.
struct Enclosure {
  double lo = 0;
  double hi = 0;

  bool operator==(const Enclosure&) const = default;
};

}  // namespace nearmiss
