// One mesh, a square, as a file of each format, and a fixture that reads such files.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include "fuzz/meshes/formats.hpp"
#include "tests/refused.hpp"
#include "tests/temporary_folder.hpp"

namespace nearmiss::mesh_files {

// The square, as one polygon or as two triangles.
inline const std::string obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.1\nf 1 2 3\nf 1 3 4\n";
inline const std::string off = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0.1\n3 0 1 2\n3 0 2 3\n";
inline const std::string points_of_ply = "0 0 0\n1 0 0\n1 1 0\n0 1 0.1\n";
inline const std::string facet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\n";
inline const std::string other_facet =
    "facet normal nan nan nan\nouter loop\nvertex -0 0 0\nvertex 1 1 0\nvertex 0 1 0.1\nendloop\nendfacet\n";
inline const std::string stl = "solid a square\n" + facet + other_facet + "endsolid a square\n";

inline std::string ply(const std::string& encoding, const std::string& coordinate, const std::string& list,
                       const std::string& numbers) {
  std::string text = "ply\nformat " + encoding + " 1.0\ncomment a square\nelement vertex 4\n";
  for (const char* name : {"x", "y", "z"}) text += "property " + coordinate + " " + name + "\n";
  return text + "element face 2\nproperty list " + list + " vertex_indices\nend_header\n" + numbers;
}

inline const std::string text_ply = ply("ascii", "double", "uchar int", points_of_ply + "3 0 1 2\n3 0 2 3\n");

template <class Number>
std::string bytes(std::initializer_list<Number> numbers, bool little_endian = true) {
  std::string all;
  for (const Number number : numbers) {
    std::array<char, sizeof number> raw{};
    std::memcpy(raw.data(), &number, sizeof number);
    if (!little_endian) std::reverse(raw.begin(), raw.end());
    for (const char c : raw) all += c;
  }
  return all;
}

template <class Coordinate>
std::string binary_ply(bool little_endian, Coordinate height = Coordinate(0.1)) {
  std::string numbers = bytes<Coordinate>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, height}, little_endian);
  for (const std::int32_t second : {1, 2})
    numbers += bytes<std::uint8_t>({3}) + bytes<std::int32_t>({0, second, second + 1}, little_endian);
  return ply(little_endian ? "binary_little_endian" : "binary_big_endian",
             sizeof(Coordinate) == 8 ? "double" : "float", "uchar int", numbers);
}

inline std::string binary_stl(float height = 0.1F, std::string header = "solid, but binary") {
  header.resize(80, ' ');
  const auto triangle = [](std::initializer_list<float> corners) {
    return bytes<float>({0, 0, NAN}) + bytes(corners) + bytes<std::uint16_t>({7});
  };
  return header + bytes<std::uint32_t>({2}) + triangle({0, 0, 0, 1, 0, 0, 1, 1, 0}) +
         triangle({-0.0F, 0, 0, 1, 1, 0, 0, 1, height});
}

inline std::string replaced(std::string text, const std::string& old, const std::string& by) {
  return text.replace(text.find(old), old.size(), by);
}

class MeshFilesTest : public testing::TemporaryFolder {
 protected:
  [[nodiscard]] Mesh read_text(const std::string& ending, const std::string& text) const {
    return read_mesh(write("mesh" + ending, text));
  }

  void expect_square(const std::string& ending, const std::string& text, double height = 0.1) const {
    using ::testing::ElementsAre;
    const Mesh mesh = read_text(ending, text);
    EXPECT_THAT(mesh.points, ElementsAre(Vector3<double>(0, 0, 0), Vector3<double>(1, 0, 0),
                                         Vector3<double>(1, 1, 0), Vector3<double>(0, 1, height)));
    EXPECT_THAT(mesh.triangles, ElementsAre(std::array{0, 1, 2}, std::array{0, 2, 3}));
  }

  void expect_refused(const std::string& ending, const std::string& text, const std::string& message) const {
    using ::testing::HasSubstr;
    const auto path = write("mesh" + ending, text);
    EXPECT_ERROR(read_mesh(path),
                 ::testing::AllOf(HasSubstr(path.string() + message), HasSubstr("expected")));
  }

  struct Change {
    std::string old, by, message;
  };

  /// Applies each change to a copy of a good file, and expects that the changed file is refused with the
  /// message of the change.
  void expect_refused_with(const std::string& ending, const std::string& good,
                           std::initializer_list<Change> changes) const {
    for (const auto& [old, by, message] : changes) expect_refused(ending, replaced(good, old, by), message);
  }
};

}  // namespace nearmiss::mesh_files
