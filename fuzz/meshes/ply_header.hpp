// The header of a PLY file, which lists the numbers in the file and their order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/meshes/lines.hpp"

namespace nearmiss::ply {

/// A type of numbers. A double can represent each of its values.
struct NumberType {
  std::string_view name, other_name;
  std::size_t bytes;
  long smallest, largest;  ///< range of an integer type; both 0 for a floating-point type

  [[nodiscard]] bool is_integer() const { return smallest != largest; }
};

struct Property {
  const NumberType* length;  ///< the type of a list's length; null if the property is not a list
  const NumberType* type;
  std::string name;
};

/// A list of items that have the same properties.
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

/// Reads all lines of the header. Throws an Error that names the line.
Header parse_header(Lines& lines);

/// The properties that a mesh needs, as pointers into the header.
struct MeshProperties {
  const Element* vertex;
  std::array<const Property*, 3> coordinates;  ///< x, y and z of a vertex
  const Property* face_vertices;               ///< list of the vertices of a face; null if there is no face
};

/// Finds these properties. Throws Error if one is missing, occurs twice or has a type that parse_ply does not
/// accept, and for primitives that the mesh would lack.
MeshProperties mesh_properties(const Header& header, std::string_view name);

}  // namespace nearmiss::ply
