// A description of a collision's first contact, used to sort findings.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "ccd/query.hpp"

namespace nearmiss {

/// The earliest contact of a query's primitives, determined by exact arithmetic.
struct ContactFeatures {
  enum class Multiplicity : std::uint8_t {
    planar,    ///< F is zero identically
    simple,    ///< the time is a simple root of F
    multiple,  ///< the time is a double or triple root of F
  };
  enum class Time : std::uint8_t { start, inside, end };  ///< t = 0, 0 < t < 1, t = 1
  enum class Location : std::uint8_t {
    interior,  ///< no weight vanishes: inside the triangle, or inside both edges
    border,    ///< one weight vanishes: on an edge of the triangle, or an end of one edge inside the other
    corner,    ///< two weights vanish: at a vertex of the triangle, or at an end of each edge
  };

  Multiplicity multiplicity{};
  Time time{};
  Location location{};
  bool degenerate = false;  ///< at that time, the triangle has no area, or edges are parallel or points

  bool operator==(const ContactFeatures&) const = default;
};

/// The features of a query's first contact; nothing if there is no collision.
std::optional<ContactFeatures> contact_features(const Query& query);

/// A text such as "simple-root inside on-edge" or "planar at-start end-on-end degenerate".
std::string to_text(Kind kind, const ContactFeatures& features);

}  // namespace nearmiss
