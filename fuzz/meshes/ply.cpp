#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <span>

#include "corpus/query_text.hpp"
#include "fuzz/meshes/formats.hpp"
#include "fuzz/meshes/ply_header.hpp"

namespace nearmiss {

namespace {

// --- numbers ----------------------------------------------------------------------------------------------

/// The numbers after the header, as text.
class TextNumbers {
 public:
  explicit TextNumbers(Lines& lines) : lines_(lines) {}

  /// The next number, which must be of this type; nothing at the end of the file.
  std::optional<double> next(const ply::NumberType& type) {
    const std::string_view word = lines_.next_word();
    if (word.empty()) return std::nullopt;
    if (type.is_integer()) return static_cast<double>(integer(word, type));
    const double value = parse_decimal(word, lines_);
    return type.bytes == sizeof(float) ? parse_float(word, lines_.where()) : value;
  }

  /// Skips numbers of this type; false at the end of the file.
  bool skip(const ply::NumberType& type, std::uint64_t count) {
    for (; count > 0; --count)
      if (!next(type)) return false;
    return true;
  }

  void expect_end() {
    const std::string_view word = lines_.next_word();
    if (!word.empty()) throw lines_.error(shown(word), "the end of the file");
  }

 private:
  [[nodiscard]] long integer(std::string_view word, const ply::NumberType& type) const {
    const auto value = parse_integer<long>(word);
    if (!value || *value < type.smallest || *value > type.largest)
      throw lines_.error(shown(word), fmt::format("an integer from {} to {}", type.smallest, type.largest));
    return *value;
  }

  Lines& lines_;
};

/// The numbers after the header, as bytes.
class BinaryNumbers {
 public:
  BinaryNumbers(std::string_view bytes, ply::Encoding encoding, std::string_view name)
      : bytes_(bytes), encoding_(encoding), name_(name) {}

  /// The next number; nothing at the end of the file.
  std::optional<double> next(const ply::NumberType& type) {
    if (bytes_.size() < type.bytes) return std::nullopt;
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < type.bytes; ++i) {
      const std::size_t from_most_significant =
          encoding_ == ply::Encoding::big_endian ? i : type.bytes - 1 - i;
      bits = bits << 8 | static_cast<unsigned char>(bytes_[from_most_significant]);
    }
    bytes_.remove_prefix(type.bytes);
    if (type.is_integer()) return static_cast<double>(signed_value(static_cast<long>(bits), type));
    if (type.bytes == sizeof(double)) return std::bit_cast<double>(bits);
    return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
  }

  /// Skips numbers of this type; false at the end of the file.
  bool skip(const ply::NumberType& type, std::uint64_t count) {
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
  /// The two's complement value of an unsigned integer with the same bits.
  static long signed_value(long value, const ply::NumberType& type) {
    return value <= type.largest ? value : value + 2 * type.smallest;
  }

  std::string_view bytes_;
  ply::Encoding encoding_;
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
  const auto as_unsigned = [](long vertex) { return static_cast<std::size_t>(vertex); };  // -1 is the largest
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

/// Reads the items of all elements, and keeps those that a mesh needs.
template <class Numbers>
class ItemReader {
 public:
  ItemReader(const ply::MeshProperties& wanted, Numbers numbers, std::string_view name)
      : wanted_(wanted), numbers_(std::move(numbers)), name_(name) {}

  PolygonSoup read(const std::vector<ply::Element>& elements) && {
    for (const ply::Element& element : elements) {
      if (element.properties.empty() && element.items > 0)  // a file could claim any number of empty items
        throw Error(fmt::format("{}: found no property of {}, expected one", name_, element.name));
      for (std::uint64_t item = 1; item <= element.items; ++item) read_item(element, item);
    }
    numbers_.expect_end();
    return std::move(soup_);
  }

 private:
  void read_item(const ply::Element& element, std::uint64_t item) {
    for (const ply::Property& property : element.properties) {
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

  /// Reads the numbers of one property; false at the end of the file.
  bool read_numbers(const ply::Property& property, std::uint64_t count) {
    if (&property == wanted_.face_vertices) return read_face_vertices(*property.type, count);
    for (std::size_t i = 0; i < 3; ++i)
      if (&property == wanted_.coordinates[i]) return read_coordinate(*property.type, static_cast<int>(i));
    return numbers_.skip(*property.type, count);
  }

  bool read_coordinate(const ply::NumberType& type, int i) {
    const std::optional<double> value = numbers_.next(type);
    if (value) point_[i] = *value;
    return value.has_value();
  }

  bool read_face_vertices(const ply::NumberType& type, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::optional<double> vertex = numbers_.next(type);
      if (!vertex) return false;
      soup_.vertices.push_back(static_cast<long>(*vertex));
    }
    soup_.sizes.push_back(count);
    return true;
  }

  const ply::MeshProperties& wanted_;
  Numbers numbers_;
  std::string_view name_;
  PolygonSoup soup_;
  Vector3<double> point_{0, 0, 0};  ///< the coordinates of this vertex
};

}  // namespace

Mesh parse_ply(std::string_view text, const std::string& name) {
  Lines lines(text, name, Lines::Comments::none);
  const ply::Header header = ply::parse_header(lines);
  const ply::MeshProperties wanted = ply::mesh_properties(header, name);
  if (header.encoding == ply::Encoding::text)
    return to_mesh(ItemReader(wanted, TextNumbers(lines), name).read(header.elements), name);
  const BinaryNumbers numbers(lines.rest(), header.encoding, name);
  return to_mesh(ItemReader(wanted, numbers, name).read(header.elements), name);
}

}  // namespace nearmiss
