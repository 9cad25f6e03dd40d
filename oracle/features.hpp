// A description of a collision's first contact, by which failures of CCDs are sorted.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// The earliest contact of a query's primitives, determined by exact arithmetic.
struct ContactFeatures {
  enum class Multiplicity : std::uint8_t {
    planar,    ///< F, the coplanarity of the vertices, is identically zero
    simple,    ///< the time of the contact is a simple root of F
    multiple,  ///< the time of the contact is a double or triple root of F
  };
  enum class Time : std::uint8_t { start, inside, end };  ///< t = 0, 0 < t < 1, t = 1
  enum class Location : std::uint8_t {
    interior,  ///< no barycentric weight vanishes: inside the triangle, or inside both edges
    border,    ///< one weight vanishes: on an edge of the triangle, or an end of one edge inside the other
    corner,    ///< two weights vanish: at a vertex of the triangle, or at an end of each edge
  };

  Multiplicity multiplicity{};
  Time time{};
  Location location{};
  bool degenerate = false;  ///< the triangle has no area, the edges are parallel, or an edge is a point

  bool operator==(const ContactFeatures&) const = default;
};

/// The features of a query's first contact; nothing if there is no collision.
std::optional<ContactFeatures> contact_features(const Query& query);

/// How the two primitives of a query first come within its separation h > 0 of each other, determined by
/// exact arithmetic.
struct ApproachFeatures {
  enum class Closest : std::uint8_t {
    vertices,         ///< a vertex of each primitive
    vertex_and_edge,  ///< a vertex and an edge, which may be an edge of the triangle
    interiors,        ///< the vertex and the inside of the triangle, or the insides of both edges
  };

  ContactFeatures::Time time{};
  Closest closest{};
  /// Whether the distance, once it has reached h for the first time, stays at h or grows again, instead of
  /// falling below h at once.
  bool touches = false;

  bool operator==(const ApproachFeatures&) const = default;
};

/// The features of the first approach in a query with h > 0; nothing if the distance is always above h.
std::optional<ApproachFeatures> approach_features(const Query& query);

/// The features as a text such as "approach inside vertex-face" or "approach at-start end-end touching".
std::string to_text(Kind kind, const ApproachFeatures& features);

/// The features as a text such as "simple-root inside on-edge" or "planar at-start end-on-end degenerate".
std::string to_text(Kind kind, const ContactFeatures& features);

}  // namespace nearmiss
