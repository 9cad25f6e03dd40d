// Tests which meshes are read from good files of all formats.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/fuzz/mesh_files.hpp"

namespace nearmiss::mesh_files {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class ReadersTest : public MeshFilesTest {};
class ObjTest : public MeshFilesTest {};

std::string with_windows_line_ends(const std::string& text) {
  std::string windows;
  for (const char c : text) windows += c == '\n' ? "\r\n" : std::string(1, c);
  return windows;
}

TEST_F(ReadersTest, EveryFormatIsRead) {
  expect_square(".obj", obj);
  expect_square(".off", off);
  expect_square(".ply", text_ply);
  expect_square(".stl", stl);
  expect_square(".stl", binary_stl(), 0.1F);
  for (const bool little_endian : {true, false}) {
    expect_square(".ply", binary_ply<double>(little_endian));
    expect_square(".ply", binary_ply<float>(little_endian), 0.1F);
  }
}

TEST_F(ReadersTest, EndingsAreReadInAnyCase) {
  expect_square(".OFF", off);
  expect_square(".Stl", stl);
  expect_refused(".xyz", off, ": found the ending '.xyz', expected .obj, .off, .ply or .stl");
  expect_refused("", off, ": found the ending ''");
}

TEST_F(ReadersTest, BlanksAndLineEndsMakeNoDifference) {
  for (const auto& [ending, text] :
       {std::pair(".obj", obj), {".off", off}, {".ply", text_ply}, {".stl", stl}}) {
    expect_square(ending, with_windows_line_ends(text));
    expect_square(ending, text.substr(0, text.size() - 1));
    expect_square(ending, text + " \t\n\n");
  }
  expect_square(
      ".off",
      "\n# a square\nOFF 4 2 # no edges\n\n0\t0 0\n1 0 0 # here\n1 1 0\n\n0 1 0.1\n3 0 1 2\n\n3 0 2 3");
  expect_square(
      ".stl",
      "SOLID\n Facet NORMAL 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 1 1 0 endloop endfacet\n" +
          other_facet + "ENDSOLID");
}

TEST_F(ReadersTest, CoordinatesAreReadToTheLastBit) {
  const std::string digits = "0.087606608360884852";
  const auto expect_exact = [&](const std::string& ending, const std::string& text) {
    expect_square(ending, replaced(text, "0 1 0.1", "0 1 " + digits), 0.087606608360884852);
    expect_square(ending, replaced(text, "0 1 0.1", "0 1 1e-310"), 1e-310);
    expect_square(ending, replaced(text, "0 1 0.1", "0 1 -1.7976931348623157e308"),
                  -std::numeric_limits<double>::max());
  };
  expect_exact(".obj", obj);
  expect_exact(".off", off);
  expect_exact(".ply", text_ply);
  expect_exact(".stl", stl);
  expect_square(".ply", binary_ply<double>(true, 0.087606608360884852), 0.087606608360884852);
}

TEST_F(ReadersTest, FloatsOfPlyAreRoundedOnce) {
  const std::string floats = ply("ascii", "float", "uchar int", points_of_ply + "3 0 1 2\n3 0 2 3\n");
  expect_square(".ply", floats, 0.1F);
  // The number is slightly above the midpoint of two floats. If it were first rounded to double, it would
  // become the midpoint.
  expect_square(".ply", replaced(floats, "0 1 0.1", "0 1 1.000000059604644775390625001"), 1 + 0x1p-23);
}

TEST_F(ReadersTest, APolygonBecomesAFan) {
  const Mesh mesh = read_text(".off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 255 0 0\n");
  EXPECT_THAT(mesh.triangles, ElementsAre(std::array{0, 1, 2}, std::array{0, 2, 3}));
}

TEST_F(ReadersTest, FacesThatAreDegenerateOrThereTwiceAreKept) {
  const std::vector<std::array<int, 3>> faces{{0, 1, 2}, {0, 1, 2}, {2, 1, 0}, {1, 1, 2}, {3, 3, 3}};
  EXPECT_EQ(
      read_text(".obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 2 3\nf 3 2 1\nf 2 2 3\nf 4 4 4\n")
          .triangles,
      faces);
  const std::string end = "3 0 1 2\n3 0 1 2\n3 2 1 0\n3 1 1 2\n3 3 3 3\n";
  EXPECT_EQ(read_text(".off", "OFF\n4 5 0\n" + points_of_ply + end).triangles, faces);
  EXPECT_EQ(read_text(".ply",
                      replaced(ply("ascii", "double", "uchar int", points_of_ply + end), "face 2", "face 5"))
                .triangles,
            faces);
}

TEST_F(ReadersTest, PointsNeedNoPrimitive) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
  for (const auto& [ending, text] :
       {std::pair<std::string, std::string>(".obj", "v 1 2 3"),
        {".off", "OFF\n1 0 0\n1 2 3"},
        {".ply", head + "end_header\n1 2 3"},
        {".ply", head + "element face 0\nproperty list uchar int vertex_indices\nend_header\n1 2 3"}}) {
    const Mesh mesh = read_text(ending, text);
    EXPECT_THAT(mesh.points, ElementsAre(Vector3<double>(1, 2, 3))) << ending;
    EXPECT_THAT(mesh.triangles, IsEmpty());
  }
  EXPECT_EQ(read_text(".off", replaced(off, "3 0 2 3", "3 0 2 1")).points.size(), 4);
}

TEST_F(ReadersTest, EverythingButTheMeshIsSkipped) {
  expect_square(
      ".off", "COFF\n4 2 0\n0 0 0 1 0 0 1\n1 0 0\n1 1 0 9\n0 1 0.1 0 0 1 1\n3 0 1 2 0.5 0.5 0\n3 0 2 3 7\n");
  expect_square(".off", "STCNOFF 4 2 5\n0 0 0\n1 0 0\n1 1 0\n0 1 0.1\n3 0 1 2\n3 0 2 3\n");
  expect_square(".ply",
                "ply\r\ncomment none\r\nformat ascii 1.0\r\nobj_info\r\nelement camera 1\r\nproperty list "
                "uchar float x\r\n"
                "element face 2\r\nproperty uchar red\r\nproperty list ushort uint32 "
                "vertex_index\r\nproperty float red\r\n"
                "element vertex 4\r\nproperty float32 nx\r\nproperty float64 z\r\nproperty double "
                "x\r\nproperty double y\r\n"
                "property float red\r\nproperty uint8 g\r\nproperty uchar b\r\nend_header\r\n"
                "2 0.5 0.5\r\n255 3 0 1 2 0.5\r\n0 3 0 2 3 0.5\r\n"
                "1 0 0 0 0.5 0 0\r\n1 0 1 0 0.5 0 0\r\n1 0 1 1 0.5 0 0\r\n1 0.1 0 1 0.5 0 0\r\n");
  expect_square(".stl",
                "solid facet\n" + facet + "endsolid facet\n\nsolid solid\n" + other_facet + "endsolid\n");
}

const std::string byte_order_mark = "\xef\xbb\xbf";

TEST_F(ReadersTest, AByteOrderMarkIsSkipped) {
  expect_square(".obj", byte_order_mark + obj);
  expect_square(".off", byte_order_mark + off);
  expect_square(".ply", byte_order_mark + text_ply);
  expect_square(".stl", byte_order_mark + stl);
  expect_square(".stl", binary_stl(0.1F, byte_order_mark + "a header of bytes"), 0.1F);
  expect_refused(".obj", byte_order_mark + "v 0 0 x\n", ":1: found 'x'");
  expect_refused(".obj", "v 0 0 0\n" + byte_order_mark + "v 0 0 0\n", ":2: found '" + byte_order_mark + "v'");
}

// --- OBJ --------------------------------------------------------------------------------------------------

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST_F(ObjTest, ReadsVerticesAndFaces) {
  const Mesh mesh = read_text(".obj",
                              "# a comment\r\nv 0.1 -2e-3 4\r\nv 1 0 0\r\nv 0 1 0\r\nvn 0 0 1\r\n"
                              "vt 0 0\r\nf 1/1/1 2//1 3\r\n");
  ASSERT_EQ(mesh.points.size(), 3);
  EXPECT_EQ(mesh.points[0], Vector3<double>(0.1, -2e-3, 4));
  EXPECT_THAT(mesh.triangles, ElementsAre(std::array{0, 1, 2}));
}

TEST_F(ObjTest, ABackslashAtTheEndOfALineContinuesIt) {
  const Mesh mesh =
      read_text(".obj", "v 0 \\\n0 0\nv 1\\\r\n 0\\\r\n0\r\nv 0 1 0\n\\\nf 1 2\\\n3\nf 2 3 1\\");
  EXPECT_THAT(mesh.points,
              ElementsAre(Vector3<double>(0, 0, 0), Vector3<double>(1, 0, 0), Vector3<double>(0, 1, 0)));
  EXPECT_THAT(mesh.triangles, ElementsAre(std::array{0, 1, 2}, std::array{1, 2, 0}));
}

TEST_F(ObjTest, AContinuedLineHasTheNumberOfItsFirstPart) {
  expect_refused(".obj", "v 0 0 0\nv 0\\\n\\\n0 x\n", ":2: found 'x'");
  expect_refused(".obj", "v 0 0\\\n0\n\n# a comment\nv 1 2\n", ":5: found 2 coordinates");
  expect_refused(".obj", "v 0 0 0\nv 1 0 0\nf 1 2 \\\n9\n", ":3: found vertex 9");
}

TEST_F(ObjTest, ABackslashElsewhereContinuesNothing) {
  const Mesh mesh = read_text(".obj", "# from C:\\models\\\nv 1 0 0\ng a\\b\nv 0 1 0 # C:\\\nv 0 0 1\n");
  EXPECT_EQ(mesh.points.size(), 3);
  expect_refused(".obj", "v 0 0 \\ 0\n", ":1: found '\\'");
  expect_refused(".off", "OFF\n4\\\n0 0\n", ":2: found ");
}

TEST_F(ObjTest, NegativeNumbersCountBackwards) {
  const Mesh mesh = read_text(".obj", square + "f -4 -2 -1\n");
  EXPECT_THAT(mesh.triangles, ElementsAre(std::array{0, 2, 3}));
}

}  // namespace
}  // namespace nearmiss::mesh_files
