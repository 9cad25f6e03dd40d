#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "corpus/query_text.hpp"
#include "fuzz/meshes/formats.hpp"
#include "fuzz/meshes/lines.hpp"

namespace nearmiss {

namespace {

// --- the header, which lists the numbers in the file and their order --------------------------------------

/// A type of the numbers in a PLY file. A double can represent every number of every type.
struct NumberType {
  std::string_view name, other_name;
  std::size_t bytes;
  /// The smallest and the largest number of an integer type; both are 0 for a floating-point type.
  long smallest, largest;

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

constexpr std::array<NumberType, 8> types{{{"char", "int8", 1, INT8_MIN, INT8_MAX},
                                           {"uchar", "uint8", 1, 0, UINT8_MAX},
                                           {"short", "int16", 2, INT16_MIN, INT16_MAX},
                                           {"ushort", "uint16", 2, 0, UINT16_MAX},
                                           {"int", "int32", 4, INT32_MIN, INT32_MAX},
                                           {"uint", "uint32", 4, 0, UINT32_MAX},
                                           {"float", "float32", 4, 0, 0},
                                           {"double", "float64", 8, 0, 0}}};

const NumberType* parse_type(std::string_view word, const Lines& lines) {
  const auto type = std::find_if(types.begin(), types.end(),
                                 [&](const NumberType& t) { return t.name == word || t.other_name == word; });
  if (type == types.end()) throw lines.error(shown(word), "a type of numbers");
  return &*type;
}

Encoding parse_encoding(std::string_view word, const Lines& lines) {
  if (word == "ascii") return Encoding::text;
  if (word == "binary_little_endian") return Encoding::little_endian;
  if (word == "binary_big_endian") return Encoding::big_endian;
  throw lines.error(shown(word), "ascii, binary_little_endian or binary_big_endian");
}

Element parse_element(const Lines& lines) {
  const auto& words = lines.words();
  if (words.size() != 3)
    throw lines.error(fmt::format("{} words", words.size()), "element, a name and a number");
  const auto items = parse_integer<std::uint64_t>(words[2]);
  if (!items) throw lines.error(shown(words[2]), "how many there are");
  return {std::string(words[1]), *items, {}};
}

Property parse_property(const Lines& lines) {
  const auto& words = lines.words();
  const bool is_list = words.size() > 1 && words[1] == "list";
  if (words.size() != (is_list ? 5 : 3))
    throw lines.error(fmt::format("{} words", words.size()), "property, a type and a name");
  if (!is_list) return {nullptr, parse_type(words[1], lines), std::string(words[2])};
  const NumberType* const length = parse_type(words[2], lines);
  if (!length->is_integer()) throw lines.error(shown(words[2]), "a type of integers for a list's length");
  return {length, parse_type(words[3], lines), std::string(words[4])};
}

/// Goes to the next line that is not a comment, and returns its first word.
std::string_view next_keyword(Lines& lines, std::string_view expected) {
  do {
    if (!lines.next()) throw lines.error(shown({}), expected);
  } while (lines.words()[0] == "comment" || lines.words()[0] == "obj_info");
  return lines.words()[0];
}

/// The element or property with the name `wanted`; null if there is none. Throws Error if there are several.
template <class Named>
const Named* find(const std::vector<Named>& all, std::string_view wanted, std::string_view name) {
  const auto has_name = [&](const Named& each) { return each.name == wanted; };
  if (std::count_if(all.begin(), all.end(), has_name) > 1)
    throw Error(fmt::format("{}: found {} twice in the header, expected it once", name, wanted));
  const auto found = std::find_if(all.begin(), all.end(), has_name);
  return found == all.end() ? nullptr : &*found;
}

const Property* find_coordinate(const Element& vertex, std::string_view coordinate, std::string_view name) {
  const Property* const property = find(vertex.properties, coordinate, name);
  if (!property || property->length || property->type->is_integer())
    throw Error(fmt::format("{}: found {} {} of a vertex, expected float or double", name,
                            property ? property->type->name : "no", coordinate));
  return property;
}

const Property* find_face_vertices(const Element& face, std::string_view name) {
  const Property* const one = find(face.properties, "vertex_index", name);
  const Property* const many = find(face.properties, "vertex_indices", name);
  if (one && many) throw Error(fmt::format("{}: found vertex_index and vertex_indices, expected one", name));
  const Property* const list = one ? one : many;
  if (!list || !list->length || (list->type->name != "int" && list->type->name != "uint"))
    throw Error(fmt::format(
        "{}: found no list of int or uint that is vertex_indices, expected the vertices of faces", name));
  return list;
}

/// Reads all lines of the header. If a line is wrong, throws an Error that names this line.
Header parse_header(Lines& lines) {
  if (next_keyword(lines, "ply") != "ply") throw lines.error(shown(lines.words()[0]), "ply");
  if (next_keyword(lines, "format") != "format" || lines.words().size() < 2)
    throw lines.error(shown(lines.words()[0]), "format and ascii, binary_little_endian or binary_big_endian");
  Header header{parse_encoding(lines.words()[1], lines), {}};
  for (;;) {
    const std::string_view keyword = next_keyword(lines, "end_header");
    if (keyword == "end_header") {
      lines.skip_line();
      return header;
    }
    if (keyword == "element") {
      header.elements.push_back(parse_element(lines));
    } else if (keyword == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(parse_property(lines));
    } else {
      throw lines.error(shown(keyword), "element, property of an element, or end_header");
    }
  }
}

/// The properties that a mesh needs, as pointers into the header.
struct MeshProperties {
  const Element* vertex;
  std::array<const Property*, 3> coordinates;  ///< x, y and z of a vertex
  const Property* face_vertices;               ///< list of the vertices of a face; null if there is no face
};

/// Throws Error if a property is missing, occurs twice or has a type that parse_ply does not accept, or if
/// the header has an element with primitives that parse_ply cannot read.
MeshProperties mesh_properties(const Header& header, std::string_view name) {
  const Element* const vertex = find(header.elements, "vertex", name);
  if (!vertex) throw Error(fmt::format("{}: found no element vertex, expected one", name));
  MeshProperties wanted{vertex, {}, nullptr};
  constexpr std::array coordinates{"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i) wanted.coordinates[i] = find_coordinate(*vertex, coordinates[i], name);
  const Element* const face = find(header.elements, "face", name);
  if (face && face->items > 0) wanted.face_vertices = find_face_vertices(*face, name);
  for (const std::string_view primitives : {"edge", "halfedge", "tristrips"})
    if (const Element* const element = find(header.elements, primitives, name); element && element->items > 0)
      throw Error(
          fmt::format("{}: found the element {}, expected no other faces or lines than the element face",
                      name, primitives));
  return wanted;
}

// --- numbers ----------------------------------------------------------------------------------------------

/// The numbers after the header, as text.
class TextNumbers {
 public:
  explicit TextNumbers(Lines& lines) : lines_(lines) {}

  /// The next number, which must be of this type. At the end of the file, returns nothing.
  std::optional<double> next(const NumberType& type) {
    const std::string_view word = lines_.next_word();
    if (word.empty()) return std::nullopt;
    if (type.is_integer()) return static_cast<double>(integer(word, type));
    const double value = parse_decimal(word, lines_);
    return type.bytes == sizeof(float) ? parse_float(word, lines_.where()) : value;
  }

  /// Skips `count` numbers of this type. Returns false if the file has fewer.
  bool skip(const NumberType& type, std::uint64_t count) {
    for (; count > 0; --count)
      if (!next(type)) return false;
    return true;
  }

  void expect_end() {
    const std::string_view word = lines_.next_word();
    if (!word.empty()) throw lines_.error(shown(word), "the end of the file");
  }

 private:
  [[nodiscard]] long integer(std::string_view word, const NumberType& type) const {
    const auto value = parse_integer<long>(word);
    if (!value || *value < type.smallest || *value > type.largest)
      throw lines_.error(shown(word), fmt::format("an integer from {} to {}", type.smallest, type.largest));
    return *value;
  }

  Lines& lines_;
};

/// The numbers after the header, as bytes. This class has the same functions as TextNumbers.
class BinaryNumbers {
 public:
  BinaryNumbers(std::string_view bytes, Encoding encoding, std::string_view name)
      : bytes_(bytes), encoding_(encoding), name_(name) {}

  std::optional<double> next(const NumberType& type) {
    if (bytes_.size() < type.bytes) return std::nullopt;
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < type.bytes; ++i) {
      const std::size_t from_most_significant = encoding_ == Encoding::big_endian ? i : type.bytes - 1 - i;
      bits = bits << 8 | static_cast<unsigned char>(bytes_[from_most_significant]);
    }
    bytes_.remove_prefix(type.bytes);
    if (type.is_integer()) return static_cast<double>(signed_value(static_cast<long>(bits), type));
    if (type.bytes == sizeof(double)) return std::bit_cast<double>(bits);
    return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
  }

  bool skip(const NumberType& type, std::uint64_t count) {
    if (count > bytes_.size() / type.bytes) return false;
    bytes_.remove_prefix(count * type.bytes);
    return true;
  }

  void expect_end() const {
    if (!bytes_.empty())
      throw Error(
          fmt::format("{}: found {} bytes too many, expected the end of the file", name_, bytes_.size()));
  }

 private:
  /// The number of the given type that has the same bits as the unsigned integer `value`. Signed types use
  /// two's complement.
  static long signed_value(long value, const NumberType& type) {
    return value <= type.largest ? value : value + 2 * type.smallest;
  }

  std::string_view bytes_;
  Encoding encoding_;
  std::string_view name_;
};

// --- mesh -------------------------------------------------------------------------------------------------

/// Points and polygons in the order of the file. Polygons may come before their points.
struct PolygonSoup {
  std::vector<Vector3<double>> points;
  std::vector<long> vertices;      ///< vertices of all polygons, one polygon after the other
  std::vector<std::size_t> sizes;  ///< number of vertices of each polygon
};

void expect_finite(const std::vector<Vector3<double>>& points, std::string_view name) {
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const double c : points[i])
      if (!std::isfinite(c))
        throw Error(fmt::format("{}: found {} in vertex {}, expected a finite number", name, c, i + 1));
}

/// Throws Error unless the polygon has at least three vertices, each an index from 0 to `points` - 1.
void expect_polygon(std::span<const long> polygon, std::size_t points, std::size_t number,
                    std::string_view name) {
  if (polygon.size() < 3)
    throw Error(
        fmt::format("{}: found face {} of {} vertices, expected at least 3", name, number, polygon.size()));
  // As an unsigned number, -1 is the largest of all.
  const auto as_unsigned = [](long vertex) { return static_cast<std::size_t>(vertex); };
  const long worst = *std::ranges::max_element(polygon, {}, as_unsigned);
  if (as_unsigned(worst) >= points)
    throw Error(
        fmt::format("{}: found vertex {} in face {}, expected 0 to {}", name, worst, number, points - 1));
}

Mesh to_mesh(PolygonSoup soup, std::string_view name) {
  expect_points(soup.points.size(), name);
  expect_finite(soup.points, name);
  Mesh mesh{std::move(soup.points), {}, {}};
  std::span<const long> rest = soup.vertices;
  for (std::size_t i = 0; i < soup.sizes.size(); ++i) {
    const auto polygon = rest.first(soup.sizes[i]);
    expect_polygon(polygon, mesh.points.size(), i + 1, name);
    add_polygon(mesh, polygon);
    rest = rest.subspan(soup.sizes[i]);
  }
  return mesh;
}

/// Reads the items of all elements, and keeps the points and polygons.
template <class Numbers>
class ItemReader {
 public:
  ItemReader(const MeshProperties& wanted, Numbers numbers, std::string_view name)
      : wanted_(wanted), numbers_(std::move(numbers)), name_(name) {}

  PolygonSoup read(const std::vector<Element>& elements) && {
    for (const Element& element : elements) {
      if (element.properties.empty() && element.items > 0)  // a file could claim any number of empty items
        throw Error(fmt::format("{}: found no property of {}, expected one", name_, element.name));
      for (std::uint64_t item = 1; item <= element.items; ++item) read_item(element, item);
    }
    numbers_.expect_end();
    return std::move(soup_);
  }

 private:
  void read_item(const Element& element, std::uint64_t item) {
    for (const Property& property : element.properties) {
      const std::optional<double> length = property.length ? numbers_.next(*property.length) : 1;
      if (length && *length < 0)
        throw Error(fmt::format("{}: found a list of {} numbers in {} {}, expected 0 or more", name_, *length,
                                element.name, item));
      if (!length || !read_numbers(property, static_cast<std::uint64_t>(*length)))
        throw Error(fmt::format("{}: found the end of the file in {} {}, expected {}", name_, element.name,
                                item, element.items));
    }
    if (&element == wanted_.vertex) soup_.points.push_back(point_);
  }

  /// Reads the numbers of one property of an item. Returns false if the file has fewer.
  bool read_numbers(const Property& property, std::uint64_t count) {
    if (&property == wanted_.face_vertices) return read_face_vertices(*property.type, count);
    for (std::size_t i = 0; i < 3; ++i)
      if (&property == wanted_.coordinates[i]) return read_coordinate(*property.type, static_cast<int>(i));
    return numbers_.skip(*property.type, count);
  }

  bool read_coordinate(const NumberType& type, int i) {
    const std::optional<double> value = numbers_.next(type);
    if (value) point_[i] = *value;
    return value.has_value();
  }

  bool read_face_vertices(const NumberType& type, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::optional<double> vertex = numbers_.next(type);
      if (!vertex) return false;
      soup_.vertices.push_back(static_cast<long>(*vertex));
    }
    soup_.sizes.push_back(count);
    return true;
  }

  const MeshProperties& wanted_;
  Numbers numbers_;
  std::string_view name_;
  PolygonSoup soup_;
  Vector3<double> point_{0, 0, 0};  ///< the coordinates of the current vertex
};

}  // namespace

Mesh parse_ply(std::string_view text, const std::string& name) {
  Lines lines(text, name, Lines::Comments::none);
  const Header header = parse_header(lines);
  const MeshProperties wanted = mesh_properties(header, name);
  if (header.encoding == Encoding::text)
    return to_mesh(ItemReader(wanted, TextNumbers(lines), name).read(header.elements), name);
  const BinaryNumbers numbers(lines.rest(), header.encoding, name);
  return to_mesh(ItemReader(wanted, numbers, name).read(header.elements), name);
}

}  // namespace nearmiss
