// Meshes from files of all formats, good and bad.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <sstream>

#include "ccd/error.hpp"
#include "fuzz/scenes/scene.hpp"
#include "tests/temporary_folder.hpp"

namespace nearmiss {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

// A square, as one polygon or two triangles.
const std::string off = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0.1\n3 0 1 2\n3 0 2 3\n";
const std::string points_of_ply = "0 0 0\n1 0 0\n1 1 0\n0 1 0.1\n";
const std::string facet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\n";
const std::string other_facet =
    "facet normal nan nan nan\nouter loop\nvertex -0 0 0\nvertex 1 1 0\nvertex 0 1 0.1\nendloop\nendfacet\n";
const std::string stl = "solid a square\n" + facet + other_facet + "endsolid a square\n";

std::string ply(const std::string& encoding, const std::string& coordinate, const std::string& list,
                const std::string& numbers) {
  std::string text = "ply\nformat " + encoding + " 1.0\ncomment a square\nelement vertex 4\n";
  for (const char* name : {"x", "y", "z"}) text += "property " + coordinate + " " + name + "\n";
  return text + "element face 2\nproperty list " + list + " vertex_indices\nend_header\n" + numbers;
}

const std::string text_ply = ply("ascii", "double", "uchar int", points_of_ply + "3 0 1 2\n3 0 2 3\n");

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

std::string binary_stl(float height = 0.1F, std::string header = "solid, but binary") {
  header.resize(80, ' ');
  const auto triangle = [](std::initializer_list<float> corners) {
    return bytes<float>({0, 0, NAN}) + bytes(corners) + bytes<std::uint16_t>({7});
  };
  return header + bytes<std::uint32_t>({2}) + triangle({0, 0, 0, 1, 0, 0, 1, 1, 0}) +
         triangle({-0.0F, 0, 0, 1, 1, 0, 0, 1, height});
}

class ReadersTest : public testing::TemporaryFolder {
 protected:
  Mesh read_text(const std::string& ending, const std::string& text) const {
    return read_mesh(write("mesh" + ending, text));
  }

  void expect_square(const std::string& ending, const std::string& text, double height = 0.1) const {
    const Mesh mesh = read_text(ending, text);
    EXPECT_THAT(mesh.points, ElementsAre(Vector3<double>(0, 0, 0), Vector3<double>(1, 0, 0),
                                         Vector3<double>(1, 1, 0), Vector3<double>(0, 1, height)));
    EXPECT_THAT(mesh.triangles, ElementsAre(std::array{0, 1, 2}, std::array{0, 2, 3}));
  }

  void expect_refused(const std::string& ending, const std::string& text, const std::string& message) const {
    const auto path = write("mesh" + ending, text);
    EXPECT_THAT([&] { read_mesh(path); },
                ThrowsMessage<Error>(AllOf(HasSubstr(path.string() + message), HasSubstr("expected"))));
  }
};

using Parse = Mesh (*)(std::istream&, const std::string&);

/// Cut anywhere, it is refused; but for the last bytes, where what is left may be whole.
void expect_refused_when_cut(Parse parse, const std::string& text, std::size_t last) {
  for (std::size_t size = 0; size + last < text.size(); ++size) {
    std::istringstream in(text.substr(0, size));
    EXPECT_THROW(parse(in, "cut"), Error) << size << " bytes of " << text;
  }
}

std::string replaced(std::string text, const std::string& old, const std::string& by) {
  return text.replace(text.find(old), old.size(), by);
}

std::string with_windows_line_ends(const std::string& text) {
  std::string windows;
  for (const char c : text) windows += c == '\n' ? "\r\n" : std::string(1, c);
  return windows;
}

TEST_F(ReadersTest, EveryFormatIsRead) {
  expect_square(".obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.1\nf 1 2 3\nf 1 3 4\n");
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

TEST_F(ReadersTest, BlanksLineEndsAndALastLineWithoutOneMakeNoDifference) {
  for (const auto& [ending, text] : {std::pair(".off", off), {".ply", text_ply}, {".stl", stl}}) {
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
  expect_exact(".off", off);
  expect_exact(".ply", text_ply);
  expect_exact(".stl", stl);
  expect_square(".ply", binary_ply<double>(true, 0.087606608360884852), 0.087606608360884852);
}

TEST_F(ReadersTest, FloatsOfPlyAreReadAsTheHeaderSays) {
  expect_square(".ply", ply("ascii", "float", "uchar int", points_of_ply + "3 0 1 2\n3 0 2 3\n"), 0.1F);
}

TEST_F(ReadersTest, APolygonBecomesAFan) {
  const Mesh mesh = read_text(".off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 255 0 0\n");
  EXPECT_THAT(mesh.triangles, ElementsAre(std::array{0, 1, 2}, std::array{0, 2, 3}));
}

TEST_F(ReadersTest, AMillionSidesAreAPolygonToo) {
  constexpr int sides = 1'000'000;
  std::string corners;
  for (int i = 0; i < sides; ++i) corners.append(" ").append(std::to_string(i % 3));
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf";
  for (int i = 0; i < sides; ++i) obj.append(" ").append(std::to_string(i % 3 + 1));
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n";
  for (const Mesh& mesh :
       {read_text(".obj", obj), read_text(".off", "OFF\n3 1 0\n" + points + "1000000" + corners),
        read_text(".ply", head + "element face 1\nproperty list int int vertex_index\nend_header\n" + points +
                              "1000000" + corners)}) {
    ASSERT_EQ(mesh.triangles.size(), sides - 2);
    EXPECT_EQ(mesh.triangles.back(), (std::array{0, (sides - 2) % 3, (sides - 1) % 3}));
  }
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

TEST_F(ReadersTest, EqualPointsOfStlAreOne) {
  const Mesh mesh = read_text(".stl", stl);  // six corners, one of them -0
  EXPECT_FALSE(std::signbit(mesh.points[0][0]));
  EXPECT_EQ(mesh.points.size(), 4);
}

TEST_F(ReadersTest, WhatIsNoMeshOfTheFormatIsPassedOver) {
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

TEST_F(ReadersTest, BadOffIsNamedWithItsLine) {
  expect_refused(".off", "", ":0: found the end of the file, expected OFF");
  expect_refused(".off", "4 2 0\n", ":1: found '4', expected OFF");
  expect_refused(".off", "OFF BINARY\n", ":1: found BINARY, expected the numbers of vertices");
  expect_refused(".off", replaced(off, "OFF", "4OFF"), ":1: found '4OFF', expected OFF");
  expect_refused(".off", replaced(off, "4 2 0", "-4 2 0"), ":2: found '-4', expected a number of vertices");
  expect_refused(".off", replaced(off, "4 2 0", "4 99999999999 0"), ":2: found '99999999999'");
  expect_refused(".off", replaced(off, "4 2 0", "0 0 0"), ": found no vertex, expected at least one");
  expect_refused(".off", replaced(off, "4 2 0", "2147483647 2 0"),
                 ":8: found the end of the file, expected vertex 7");
  expect_refused(".off", replaced(off, "4 2 0", "4 2000000000 0"),
                 ":8: found the end of the file, expected face 3 of");
  expect_refused(".off", replaced(off, "4 2 0", "4 1 0"), ":8: found '3', expected the end of the file");
  expect_refused(".off", replaced(off, "1 0 0", "1 0"), ":4: found 2 coordinates of a vertex, expected 3");
  expect_refused(".off", replaced(off, "1 0 0", "1 0 nan"), ":4: found 'nan', expected a finite number");
  expect_refused(".off", replaced(off, "1 0 0", "1 -inf 0"), ":4: found '-inf', expected a finite number");
  expect_refused(".off", replaced(off, "1 0 0", "1 0 1e400"), ":4: found '1e400', expected a finite number");
  expect_refused(".off", replaced(off, "1 0 0", "1 0 0,5"), ":4: found '0,5', expected a finite number");
  expect_refused(".off", replaced(off, "1 0 0", "1 0 0x1"), ":4: found '0x1', expected a decimal number");
  expect_refused(".off", replaced(off, "3 0 1 2", "3 0 1 4"), ":7: found '4', expected a vertex from 0 to 3");
  expect_refused(".off", replaced(off, "3 0 1 2", "3 0 1 -1"),
                 ":7: found '-1', expected a vertex from 0 to 3");
  expect_refused(".off", replaced(off, "3 0 1 2", "3 0 1 0.5"),
                 ":7: found '0.5', expected a vertex from 0 to 3");
  expect_refused(".off", replaced(off, "3 0 1 2", "3 0 1"), ":7: found 2 vertices of a face, expected 3");
  expect_refused(".off", replaced(off, "3 0 1 2", "2 0 1"),
                 ":7: found a face of 2 vertices, expected at least 3");
  expect_refused(".off", replaced(off, "3 0 1 2", "2000000000 0 1 2"),
                 ":7: found 3 vertices of a face, expected 2000000000");
}

TEST_F(ReadersTest, BadPlyIsNamedWithItsLine) {
  const auto refused = [&](const std::string& old, const std::string& by, const std::string& message) {
    expect_refused(".ply", replaced(text_ply, old, by), message);
  };
  expect_refused(".ply", "", ":0: found the end of the file, expected ply");
  refused("ply", "play", ":1: found 'play', expected ply");
  refused("ascii", "utf8", ":2: found 'utf8', expected ascii");
  refused("element vertex 4", "element vertex four", ":4: found 'four', expected how many there are");
  refused("element vertex 4", "property float x", ":4: found 'property', expected element");
  refused("element vertex 4", "element vertex", ":4: found 2 words, expected element");
  refused("element vertex 4", "element point 4", ": found no element vertex, expected one");
  refused("element vertex 4", "element vertex 0\nproperty float x\nelement vertex 4", ": found vertex twice");
  refused("vertex 4", "vertex 18446744073709551615",
          ": found the end of the file in vertex 7, expected 18446744073709551615");
  refused("double x", "real x", ":5: found 'real', expected a type of numbers");
  refused("double x", "int x", ": found int x of a vertex, expected float or double");
  refused("double x", "double u", ": found no x of a vertex, expected float or double");
  refused("double y", "double x", ": found x twice in the header, expected it once");
  refused("list uchar int", "list float int", ":9: found 'float', expected a type of integers");
  refused("list uchar int", "list uchar short", ": found no list of int or uint that is vertex_indices");
  refused("vertex_indices", "corners", ": found no list of int or uint that is vertex_indices");
  refused("face 2", "edge 2", ": found the element edge, expected no other primitives than face");
  refused("face 2", "face 2\nelement nothing 1000000000000", ": found no");
  refused("end_header\n", "", ":10: found '0', expected element, property of an element, or end_header");
  refused("1 0 0", "1 0 nan", ":12: found 'nan', expected a finite number");
  refused("1 0 0", "1 0 inf", ":12: found 'inf', expected a finite number");
  refused("1 0 0", "1 0 0x1", ":12: found '0x1', expected a decimal number");
  refused("3 0 1 2", "3 0 1 2.5", ":15: found '2.5', expected an integer");
  refused("3 0 1 2", "256 0 1 2", ":15: found '256', expected an integer from 0 to 255");
  refused("3 0 1 2", "2 0 1", ": found face 1 of 2 vertices, expected at least 3");
  refused("3 0 2 3", "3 0 2 4", ": found vertex 4 in face 2, expected 0 to 3");
  refused("3 0 2 3", "3 0 2 -1", ": found vertex -1 in face 2, expected 0 to 3");
  refused("3 0 2 3", "3 0 2", ": found the end of the file in face 2, expected 2");
  refused("3 0 2 3", "3 0 2 3 3", ":16: found '3', expected the end of the file");
  expect_refused(".ply", replaced(replaced(text_ply, "uchar int", "int int"), "3 0 1 2", "-1 0 1 2"),
                 ": found a list of -1 numbers in face 1");
  expect_refused(".ply", replaced(ply("ascii", "float", "uchar int", points_of_ply), "0.1", "1e39"),
                 ":14: found '1e39', expected a number that a float can be");
}

TEST_F(ReadersTest, BadBinaryPlyIsNamed) {
  const std::string good = binary_ply<double>(false);
  expect_refused(".ply", binary_ply<double>(true, NAN), ": found nan in vertex 4, expected a finite number");
  expect_refused(".ply", binary_ply<float>(false, -INFINITY), ": found -inf in vertex 4");
  expect_refused(".ply", good + "x", ": found 1 bytes too many, expected the end of the file");
  expect_refused(".ply", replaced(good, "vertex 4", "vertex 4000000000"),
                 ": found the end of the file in vertex");
  for (const char* length : {"uint", "int", "short", "char"})
    expect_refused(
        ".ply",
        replaced(good, "list uchar", std::string("list ") + length).replace(good.size() - 15, 2, "\xff\xff"),
        ": found ");
}

TEST_F(ReadersTest, BadStlIsNamedWithItsLine) {
  const auto refused = [&](const std::string& old, const std::string& by, const std::string& message) {
    expect_refused(".stl", replaced(stl, old, by), message);
  };
  expect_refused(".stl", "", ": found 0 bytes, expected 84 of a binary STL file, or text");
  expect_refused(".stl", "solid\nendsolid\n", ": found no vertex, expected at least one");
  refused("solid", "rigid", ": found ");
  refused("facet normal", "facet", ":2: found '0', expected 'normal'");
  refused("vertex 1 0 0", "vertex 1 0 nan", ":5: found 'nan', expected a finite number");
  refused("vertex 1 0 0", "vertex 1 0 inf", ":5: found 'inf', expected a finite number");
  refused("vertex 1 0 0", "vertex 1 0", ":6: found 'vertex', expected a finite number");
  refused("vertex 1 0 0\n", "", ":6: found 'endloop', expected 'vertex'");
  refused("vertex 1 0 0\n", "vertex 1 0 0\nvertex 2 2 2\n", ":7: found 'vertex', expected 'endloop'");
  refused("endsolid", "end", ":16: found 'end', expected 'facet' or 'endsolid'");
  expect_refused(".stl", stl + "more", ":17: found 'more', expected 'solid'");
  expect_refused(".stl", binary_stl(NAN), ": found nan in facet 2, expected a finite number");
  expect_refused(".stl", binary_stl(INFINITY), ": found inf in facet 2, expected a finite number");
  expect_refused(".stl", binary_stl(0, "") + "x", ": found 185 bytes, expected 184 of a binary STL file");
  expect_refused(".stl", binary_stl(0, "").replace(80, 4, "\xff\xff\xff\xff"),
                 ": found 184 bytes, expected 214748364834 of");
}

TEST_F(ReadersTest, WhatCannotBeReadIsRefused) {
  for (const char* ending : {".obj", ".off", ".ply", ".stl"}) {
    EXPECT_THAT([&] { read_mesh(file(std::string("none") + ending)); },
                ThrowsMessage<Error>(HasSubstr(": cannot be read")));
    std::filesystem::create_directory(file(std::string("folder") + ending));
    EXPECT_THAT([&] { read_mesh(file(std::string("folder") + ending)); },
                ThrowsMessage<Error>(HasSubstr(": cannot be read")));
  }
}

// What the format can tell is not read as a smaller mesh: text may lack its last newline, and a name.
TEST(CutReadersTest, ACutFileIsRefused) {
  expect_refused_when_cut(parse_off, off, 1);
  expect_refused_when_cut(parse_ply, text_ply, 1);
  expect_refused_when_cut(parse_stl, stl, std::string(" a square\n").size());
  expect_refused_when_cut(parse_stl, binary_stl(), 0);
  expect_refused_when_cut(parse_stl, binary_stl(0.1F, "STL"), 0);
  for (const bool little_endian : {true, false}) {
    expect_refused_when_cut(parse_ply, binary_ply<double>(little_endian), 0);
    expect_refused_when_cut(parse_ply, binary_ply<float>(little_endian), 0);
  }
}

TEST(CutReadersTest, ACutObjIsRefusedOrASmallerMesh) {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\nl 4 1\n";
  for (std::size_t size = 0; size < text.size(); ++size) {
    std::istringstream in(text.substr(0, size));
    try {
      const Mesh mesh = parse_obj(in, "cut");
      EXPECT_EQ(mesh.points.size(), std::min<std::size_t>(4, (size + 2) / 8)) << size;
      EXPECT_LE(mesh.triangles.size(), 2);
    } catch (const Error&) {  // refused
    }
  }
}

// --- bodies -----------------------------------------------------------------------------------------------

TEST(BodiesTest, AreWhatTrianglesAndLinesJoin) {
  const Mesh mesh{
      std::vector<Vector3<double>>(9, Vector3<double>(0, 0, 0)), {{7, 1, 4}, {3, 3, 0}}, {{4, 8}, {5, 6}}};
  const Bodies found = bodies(mesh);
  EXPECT_EQ(found.count, 4);
  EXPECT_THAT(found.of_point, ElementsAre(0, 1, 2, 0, 1, 3, 3, 1, 1));
}

TEST(BodiesTest, OfALongStripIsOne) {
  constexpr int points = 1'000'000;
  Mesh mesh{std::vector<Vector3<double>>(points, Vector3<double>(0, 0, 0)), {}, {}};
  for (int i = points - 1; i > 0; --i) mesh.lines.push_back({i, i - 1});
  EXPECT_EQ(bodies(mesh).count, 1);
}

}  // namespace
}  // namespace nearmiss
