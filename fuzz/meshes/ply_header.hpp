// The header of a PLY file: which numbers the file holds, and in which order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/meshes/lines.hpp"

namespace nearmiss::ply {

/// A type of numbers. A double can be each of its values.
struct NumberType {
  std::string_view name, other_name;
  std::size_t bytes;
  long smallest, largest;  ///< of integers; both 0 for a floating-point type

  [[nodiscard]] bool is_integer() const { return smallest != largest; }
};

struct Property {
  const NumberType* length;  ///< the type of a list's length; null if the property is no list
  const NumberType* type;
  std::string name;
};

/// Items that each have the same properties.
struct Element {
  std::string name;
  std::uint64_t items;
  std::vector<Property> properties;
};

enum class Encoding { text, little_endian, big_endian };

struct Header {
  Encoding encoding{};
  std::vector<Element> elements;
};

/// Reads all lines of the header. Throws Error with the line.
Header parse_header(Lines& lines);

/// The properties that a mesh needs. Points into the header.
struct MeshProperties {
  const Element* vertex;
  std::array<const Property*, 3> coordinates;  ///< of vertex
  const Property* face_vertices;               ///< a list of the vertices of a face; null if there is no face
};

/// Throws Error if something is missing, is there twice or has another type than parse_ply promises, and for
/// primitives that a mesh would lack.
MeshProperties mesh_properties(const Header& header, std::string_view name);

}  // namespace nearmiss::ply
