#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <vector>

#include "fuzz/meshes/lines.hpp"
#include "fuzz/meshes/plain.hpp"

namespace nearmiss {

namespace {

struct Type {
  std::string_view name, other_name;
  std::size_t bytes;
  long smallest, largest;  ///< of an integer; both 0 for a floating-point type

  [[nodiscard]] bool is_integer() const { return smallest != largest; }
};

constexpr std::array<Type, 8> types{{{"char", "int8", 1, INT8_MIN, INT8_MAX},
                                     {"uchar", "uint8", 1, 0, UINT8_MAX},
                                     {"short", "int16", 2, INT16_MIN, INT16_MAX},
                                     {"ushort", "uint16", 2, 0, UINT16_MAX},
                                     {"int", "int32", 4, INT32_MIN, INT32_MAX},
                                     {"uint", "uint32", 4, 0, UINT32_MAX},
                                     {"float", "float32", 4, 0, 0},
                                     {"double", "float64", 8, 0, 0}}};

struct Property {
  const Type* length;  ///< of a list's length; null where it is no list
  const Type* type;
  std::string name;
};

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

// --- the header -------------------------------------------------------------------------------------------

const Type* parse_type(std::string_view word, const Lines& lines) {
  const auto type = std::find_if(types.begin(), types.end(),
                                 [&](const Type& t) { return t.name == word || t.other_name == word; });
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
  std::uint64_t items = 0;
  const char* const end = words[2].data() + words[2].size();
  const auto [rest, error] = std::from_chars(words[2].data(), end, items);
  if (error != std::errc() || rest != end) throw lines.error(shown(words[2]), "how many there are");
  return {std::string(words[1]), items, {}};
}

Property parse_property(const Lines& lines) {
  const auto& words = lines.words();
  const bool is_list = words.size() > 1 && words[1] == "list";
  if (words.size() != (is_list ? 5 : 3))
    throw lines.error(fmt::format("{} words", words.size()), "property, a type and a name");
  if (!is_list) return {nullptr, parse_type(words[1], lines), std::string(words[2])};
  const Type* const length = parse_type(words[2], lines);
  if (!length->is_integer()) throw lines.error(shown(words[2]), "a type of integers for a list's length");
  return {length, parse_type(words[3], lines), std::string(words[4])};
}

Header parse_header(Lines& lines) {
  const auto next = [&](std::string_view expected) {
    do {
      if (!lines.next()) throw lines.error(shown({}), expected);
    } while (lines.words()[0] == "comment" || lines.words()[0] == "obj_info");
    return lines.words()[0];
  };
  if (next("ply") != "ply") throw lines.error(shown(lines.words()[0]), "ply");
  if (next("format") != "format" || lines.words().size() < 2)
    throw lines.error(shown(lines.words()[0]), "format and ascii, binary_little_endian or binary_big_endian");
  Header header{parse_encoding(lines.words()[1], lines), {}};
  for (;;) {
    const std::string_view keyword = next("end_header");
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

// --- what is read -----------------------------------------------------------------------------------------

/// Throws Error where a name is there more than once.
template <class Named>
const Named* find(const std::vector<Named>& all, std::string_view wanted, std::string_view name) {
  const auto has_name = [&](const Named& each) { return each.name == wanted; };
  if (std::count_if(all.begin(), all.end(), has_name) > 1)
    throw Error(fmt::format("{}: found {} twice in the header, expected it once", name, wanted));
  const auto found = std::find_if(all.begin(), all.end(), has_name);
  return found == all.end() ? nullptr : &*found;
}

void expect_coordinates(const Element& vertex, std::string_view name) {
  for (const std::string_view coordinate : {"x", "y", "z"}) {
    const Property* const property = find(vertex.properties, coordinate, name);
    if (!property || property->length || property->type->is_integer())
      throw Error(fmt::format("{}: found {} {} of a vertex, expected float or double", name,
                              property ? property->type->name : "no", coordinate));
  }
}

/// The property that lists the vertices of a face.
const Property* indices(const Element& face, std::string_view name) {
  const Property* const one = find(face.properties, "vertex_index", name);
  const Property* const many = find(face.properties, "vertex_indices", name);
  if (one && many) throw Error(fmt::format("{}: found vertex_index and vertex_indices, expected one", name));
  const Property* const list = one ? one : many;
  if (!list || !list->length || (list->type->name != "int" && list->type->name != "uint"))
    throw Error(fmt::format(
        "{}: found no list of int or uint that is vertex_indices, expected the vertices of faces", name));
  return list;
}

/// The header without the names of what is not read.
std::string plain_header(const Header& header, std::string_view name) {
  const Element* const vertex = find(header.elements, "vertex", name);
  if (!vertex) throw Error(fmt::format("{}: found no element vertex, expected one", name));
  expect_coordinates(*vertex, name);
  const Element* const face = find(header.elements, "face", name);
  const Property* const list = face && face->items > 0 ? indices(*face, name) : nullptr;
  for (const std::string_view primitives : {"edge", "halfedge", "tristrips"})
    if (const Element* const element = find(header.elements, primitives, name); element && element->items > 0)
      throw Error(
          fmt::format("{}: found the element {}, expected no other primitives than face", name, primitives));
  constexpr std::array encodings{"ascii", "binary_little_endian", "binary_big_endian"};
  std::string plain =
      fmt::format("ply\nformat {} 1.0\n", encodings[static_cast<std::size_t>(header.encoding)]);
  for (const Element& element : header.elements) {
    const bool is_read = &element == vertex || (&element == face && list);
    plain += fmt::format("element {} {}\n", is_read ? element.name : "other", element.items);
    for (const Property& p : element.properties) {
      const bool is_coordinate = &element == vertex && (p.name == "x" || p.name == "y" || p.name == "z");
      plain += fmt::format("property {}{} {}\n", p.length ? fmt::format("list {} ", p.length->name) : "",
                           p.type->name,
                           &p == list      ? "vertex_indices"
                           : is_coordinate ? p.name
                                           : "other");
    }
  }
  return plain + "end_header\n";
}

// --- the numbers ------------------------------------------------------------------------------------------

/// The numbers behind the header, as text.
class TextNumbers {
 public:
  explicit TextNumbers(Lines& lines) : lines_(lines) {}

  /// One number of this type; nothing at the end of the file.
  std::optional<long> integer(const Type& type) {
    const std::string_view word = lines_.next_word();
    if (word.empty()) return std::nullopt;
    long value = 0;
    const char* const end = word.data() + word.size();
    const auto [rest, error] = std::from_chars(word.data(), end, value);
    if (error != std::errc() || rest != end || value < type.smallest || value > type.largest)
      throw lines_.error(shown(word), fmt::format("an integer from {} to {}", type.smallest, type.largest));
    return value;
  }

  /// Reads over so many numbers; false at the end of the file.
  bool pass(const Type& type, long count) {
    for (; count > 0; --count)
      if (!(type.is_integer() ? integer(type).has_value() : real(type))) return false;
    return true;
  }

  void expect_end() {
    const std::string_view word = lines_.next_word();
    if (!word.empty()) throw lines_.error(shown(word), "the end of the file");
  }

 private:
  bool real(const Type& type) {
    const std::string_view word = lines_.next_word();
    if (word.empty()) return false;
    expect_decimal(word, lines_);
    if (type.bytes == sizeof(float) && !std::isfinite(std::strtof(std::string(word).c_str(), nullptr)))
      throw lines_.error(shown(word), "a number that a float can be");
    return true;
  }

  Lines& lines_;
};

/// The numbers behind the header, as bytes.
class BinaryNumbers {
 public:
  BinaryNumbers(std::string_view bytes, Encoding encoding, std::string_view name)
      : bytes_(bytes), encoding_(encoding), name_(name) {}

  std::optional<long> integer(const Type& type) {
    if (bytes_.size() < type.bytes) return std::nullopt;
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < type.bytes; ++i) {
      const std::size_t from_most_significant = encoding_ == Encoding::big_endian ? i : type.bytes - 1 - i;
      value = value << 8 | static_cast<unsigned char>(bytes_[from_most_significant]);
    }
    bytes_.remove_prefix(type.bytes);
    if (type.smallest == 0 || value <= type.largest) return value;
    return static_cast<long>(value) + 2 * type.smallest;
  }

  bool pass(const Type& type, long count) {
    if (static_cast<std::size_t>(count) > bytes_.size() / type.bytes) return false;
    bytes_.remove_prefix(static_cast<std::size_t>(count) * type.bytes);
    return true;
  }

  void expect_end() const {
    if (!bytes_.empty())
      throw Error(
          fmt::format("{}: found {} bytes too many, expected the end of the file", name_, bytes_.size()));
  }

 private:
  std::string_view bytes_;
  Encoding encoding_;
  std::string_view name_;
};

/// Throws Error where the file does not hold what its header says.
template <class Numbers>
void expect_all(const Header& header, Numbers numbers, std::string_view name) {
  for (const Element& element : header.elements) {
    if (element.properties.empty() && element.items > 0)  // they would be there without a byte
      throw Error(fmt::format("{}: found no property of {}, expected one", name, element.name));
    for (std::uint64_t i = 0; i < element.items; ++i) {
      for (const Property& property : element.properties) {
        const std::optional<long> length = property.length ? numbers.integer(*property.length) : 1;
        if (length && *length < 0)
          throw Error(fmt::format("{}: found a list of {} numbers in {} {}, expected 0 or more", name,
                                  *length, element.name, i + 1));
        if (!length || !numbers.pass(*property.type, *length))
          throw Error(fmt::format("{}: found the end of the file in {} {}, expected {}", name, element.name,
                                  i + 1, element.items));
      }
    }
  }
  numbers.expect_end();
}

}  // namespace

std::string plain_ply(std::string_view text, std::string_view name) {
  Lines lines(text, name, Lines::Comments::none);
  const Header header = parse_header(lines);
  std::string plain = plain_header(header, name);
  const std::string_view body = lines.rest();
  if (header.encoding == Encoding::text)
    expect_all(header, TextNumbers(lines), name);
  else
    expect_all(header, BinaryNumbers(body, header.encoding, name), name);
  return plain.append(body);
}

}  // namespace nearmiss
