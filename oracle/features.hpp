// A description of the first contact of a collision, by which findings are sorted.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "ccd/query.hpp"

namespace nearmiss {

/// The earliest contact of a query's primitives, as exact arithmetic sees it.
struct ContactFeatures {
  enum class Multiplicity : std::uint8_t {
    planar,    ///< F is zero identically
    simple,    ///< the time is a simple root of F
    multiple,  ///< a double or triple one
  };
  enum class Time : std::uint8_t { start, inside, end };  ///< t = 0, 0 < t < 1, t = 1
  enum class Location : std::uint8_t {
    interior,  ///< no weight vanishes: within the face, or within both edges
    border,    ///< one does: on an edge of the triangle, or an end of one edge within the other
    corner,    ///< two do: in a vertex of the triangle, or an end of each edge
  };

  Multiplicity multiplicity{};
  Time time{};
  Location location{};
  bool degenerate = false;  ///< then: the triangle has no area, or the edges are parallel or without a length

  bool operator==(const ContactFeatures&) const = default;
};

/// The features of a collision, by exact arithmetic; nothing if there is no collision.
std::optional<ContactFeatures> contact_features(const Query& query);

/// "simple-root inside on-edge", "planar at-start end-on-end degenerate" and so on.
std::string to_text(Kind kind, const ContactFeatures& features);

}  // namespace nearmiss
