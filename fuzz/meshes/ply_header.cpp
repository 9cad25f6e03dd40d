#include "fuzz/meshes/ply_header.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "corpus/query_text.hpp"

namespace nearmiss::ply {

namespace {

constexpr std::array<NumberType, 8> types{{{"char", "int8", 1, INT8_MIN, INT8_MAX},
                                           {"uchar", "uint8", 1, 0, UINT8_MAX},
                                           {"short", "int16", 2, INT16_MIN, INT16_MAX},
                                           {"ushort", "uint16", 2, 0, UINT16_MAX},
                                           {"int", "int32", 4, INT32_MIN, INT32_MAX},
                                           {"uint", "uint32", 4, 0, UINT32_MAX},
                                           {"float", "float32", 4, 0, 0},
                                           {"double", "float64", 8, 0, 0}}};

// --- lines ------------------------------------------------------------------------------------------------

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

// --- properties -------------------------------------------------------------------------------------------

/// The element or property with this name; null if there is none. Throws Error if there are several.
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

}  // namespace

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

}  // namespace nearmiss::ply
