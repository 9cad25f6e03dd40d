// Bad mesh files of all formats are refused with a message.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "ccd/query/error.hpp"
#include "tests/fuzz/mesh_files.hpp"
#include "tests/refused.hpp"

namespace nearmiss::mesh_files {
namespace {

class BadFilesTest : public MeshFilesTest {};

TEST_F(BadFilesTest, WhatCannotBeReadIsRefused) {
  for (const char* ending : {".obj", ".off", ".ply", ".stl"}) {
    EXPECT_REFUSED(read_mesh(file(std::string("none") + ending)), ": cannot be read");
    std::filesystem::create_directory(file(std::string("folder") + ending));
    EXPECT_REFUSED(read_mesh(file(std::string("folder") + ending)), ": found a folder, expected a file");
  }
}

TEST_F(BadFilesTest, FilesThatAreTooLargeAreRefused) {
  for (const char* ending : {".obj", ".off", ".ply", ".stl"}) {
    const auto sparse = write(std::string("sparse") + ending, "");
    resize_file(sparse, std::uintmax_t{1} << 31);
    EXPECT_REFUSED(read_mesh(sparse), ": found 2147483648 bytes, expected at most 1073741824");
  }
}

TEST_F(BadFilesTest, BadOffIsNamedWithItsLine) {
  expect_refused(".off", "", ":0: found the end of the file, expected OFF");
  expect_refused(".off", "4 2 0\n", ":1: found '4', expected OFF");
  expect_refused(".off", "OFF BINARY\n", ":1: found BINARY, expected the numbers of vertices");
  expect_refused_with(
      ".off", off,
      {
          {"OFF", "4OFF", ":1: found '4OFF', expected OFF"},
          {"4 2 0", "-4 2 0", ":2: found '-4', expected a number of vertices"},
          {"4 2 0", "4 99999999999 0", ":2: found '99999999999'"},
          {"4 2 0", "0 0 0", ": found no vertex, expected at least one"},
          {"4 2 0", "2147483647 2 0", ":8: found the end of the file, expected vertex 7"},
          {"4 2 0", "4 2000000000 0", ":8: found the end of the file, expected face 3 of"},
          {"4 2 0", "4 1 0", ":8: found '3', expected the end of the file"},
          {"1 0 0", "1 0", ":4: found 2 coordinates of a vertex, expected 3"},
          {"1 0 0", "1 0 nan", ":4: found 'nan', expected a finite number"},
          {"1 0 0", "1 -inf 0", ":4: found '-inf', expected a finite number"},
          {"1 0 0", "1 0 1e400", ":4: found '1e400', expected a finite number"},
          {"1 0 0", "1 0 0,5", ":4: found '0,5', expected a finite number"},
          {"1 0 0", "1 0 0x1", ":4: found '0x1', expected a decimal number"},
          {"3 0 1 2", "3 0 1 4", ":7: found '4', expected a vertex from 0 to 3"},
          {"3 0 1 2", "3 0 1 -1", ":7: found '-1', expected a vertex from 0 to 3"},
          {"3 0 1 2", "3 0 1 0.5", ":7: found '0.5', expected a vertex from 0 to 3"},
          {"3 0 1 2", "3 0 1", ":7: found 2 vertices of a face, expected 3"},
          {"3 0 1 2", "2 0 1", ":7: found a face of 2 vertices, expected at least 3"},
          {"3 0 1 2", "2000000000 0 1 2", ":7: found 3 vertices of a face, expected 2000000000"},
      });
}

TEST_F(BadFilesTest, BadPlyIsNamedWithItsLine) {
  expect_refused(".ply", "", ":0: found the end of the file, expected ply");
  expect_refused_with(
      ".ply", text_ply,
      {
          {"ply", "play", ":1: found 'play', expected ply"},
          {"ascii", "utf8", ":2: found 'utf8', expected ascii"},
          {"element vertex 4", "element vertex four", ":4: found 'four', expected how many there are"},
          {"element vertex 4", "property float x", ":4: found 'property', expected element"},
          {"element vertex 4", "element vertex", ":4: found 2 words, expected element"},
          {"element vertex 4", "element point 4", ": found no element vertex, expected one"},
          {"element vertex 4", "element vertex 0\nproperty float x\nelement vertex 4",
           ": found vertex twice"},
          {"vertex 4", "vertex 18446744073709551615",
           ": found the end of the file in vertex 7, expected 18446744073709551615"},
          {"double x", "real x", ":5: found 'real', expected a type of numbers"},
          {"double x", "int x", ": found int x of a vertex, expected float or double"},
          {"double x", "double u", ": found no x of a vertex, expected float or double"},
          {"double y", "double x", ": found x twice in the header, expected it once"},
          {"list uchar int", "list float int", ":9: found 'float', expected a type of integers"},
          {"list uchar int", "list uchar short", ": found no list of int or uint that is vertex_indices"},
          {"vertex_indices", "corners", ": found no list of int or uint that is vertex_indices"},
          {"face 2", "edge 2",
           ": found the element edge, expected no other faces or lines than the element face"},
          {"face 2", "face 2\nelement nothing 1000000000000", ": found no"},
          {"end_header\n", "", ":10: found '0', expected element, property of an element, or end_header"},
          {"1 0 0", "1 0 nan", ":12: found 'nan', expected a finite number"},
          {"1 0 0", "1 0 inf", ":12: found 'inf', expected a finite number"},
          {"1 0 0", "1 0 0x1", ":12: found '0x1', expected a decimal number"},
          {"3 0 1 2", "3 0 1 2.5", ":15: found '2.5', expected an integer"},
          {"3 0 1 2", "256 0 1 2", ":15: found '256', expected an integer from 0 to 255"},
          {"3 0 1 2", "2 0 1", ": found face 1 of 2 vertices, expected at least 3"},
          {"3 0 2 3", "3 0 2 4", ": found vertex 4 in face 2, expected 0 to 3"},
          {"3 0 2 3", "3 0 2 -1", ": found vertex -1 in face 2, expected 0 to 3"},
          {"3 0 2 3", "3 0 2", ": found the end of the file in face 2, expected 2"},
          {"3 0 2 3", "3 0 2 3 3", ":16: found '3', expected the end of the file"},
      });
  expect_refused(".ply", replaced(replaced(text_ply, "uchar int", "int int"), "3 0 1 2", "-1 0 1 2"),
                 ": found a list of -1 numbers in face 1");
  expect_refused(".ply", replaced(ply("ascii", "float", "uchar int", points_of_ply), "0.1", "1e39"),
                 ":14: found '1e39', expected a number in the range of float");
}

TEST_F(BadFilesTest, BadBinaryPlyIsNamed) {
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

TEST_F(BadFilesTest, BadStlIsNamedWithItsLine) {
  expect_refused(".stl", "", ": found 0 bytes, expected 84 of a binary STL file, or text");
  expect_refused(".stl", "solid\nendsolid\n", ": found no vertex, expected at least one");
  expect_refused_with(
      ".stl", stl,
      {
          {"solid", "rigid", ": found "},
          {"facet normal", "facet", ":2: found '0', expected 'normal'"},
          {"vertex 1 0 0", "vertex 1 0 nan", ":5: found 'nan', expected a finite number"},
          {"vertex 1 0 0", "vertex 1 0 inf", ":5: found 'inf', expected a finite number"},
          {"vertex 1 0 0", "vertex 1 0", ":6: found 'vertex', expected a finite number"},
          {"vertex 1 0 0\n", "", ":6: found 'endloop', expected 'vertex'"},
          {"vertex 1 0 0\n", "vertex 1 0 0\nvertex 2 2 2\n", ":7: found 'vertex', expected 'endloop'"},
          {"endsolid", "end", ":16: found 'end', expected 'facet' or 'endsolid'"},
      });
  expect_refused(".stl", stl + "more", ":17: found 'more', expected 'solid'");
  expect_refused(".stl", binary_stl(NAN), ": found nan in facet 2, expected a finite number");
  expect_refused(".stl", binary_stl(INFINITY), ": found inf in facet 2, expected a finite number");
  expect_refused(".stl", binary_stl(0, "") + "x", ": found 185 bytes, expected 184 of a binary STL file");
  expect_refused(".stl", binary_stl(0, "").replace(80, 4, "\xff\xff\xff\xff"),
                 ": found 184 bytes, expected 214748364834 of");
}

TEST_F(BadFilesTest, BadObjIsNamedWithItsLine) {
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const auto expect_refused_line = [&](const std::string& line, const std::string& message) {
    expect_refused(".obj", square + line, message);
  };
  expect_refused_line("f 1 2 " + std::string(1000, '9') + "\n",
                      ":5: found '" + std::string(40, '9') + "...' in a face");
  expect_refused_line("v 1 2 " + std::string(1000, 'x') + "\n",
                      ":5: found '" + std::string(40, 'x') + "...', expected");
  expect_refused_line("f 1 2 5\n", ":5: found vertex 5 in a face, expected at most 4");
  expect_refused_line("f 1 2 0\n", ":5: found vertex 0 in a face");
  expect_refused_line("f 1 2 -5\n", ":5: found vertex -5 in a face");
  expect_refused_line("f 1 2\n", ":5: found a face of 2 vertices");
  expect_refused_line("f 1 2 x\n", ":5: found 'x' in a face");
  expect_refused_line("l 1 5\n", ":5: found vertex 5 in a polyline, expected at most 4");
  expect_refused_line("l 1\n", ":5: found a polyline of 1 vertices, expected at least 2");
  expect_refused_line("f 1 2 3\nrubbish\n", ":6: found 'rubbish', expected a line of the OBJ format");
  expect_refused(".obj", "v 0 0 0\nv 0 nan 0\nf 1 1 1\n", ":2: found 'nan', expected a finite number");
  expect_refused(".obj", "v 0 0\n", ":1: found 2 coordinates of a vertex");
  expect_refused(".obj", "", ": found no vertex");
}

// --- files that were cut ----------------------------------------------------------------------------------

using Parse = Mesh (*)(std::string_view, const std::string&);

/// Expects that a file is refused if more than `last` bytes are missing at its end.
void expect_refused_when_cut(Parse parse, const std::string& text, std::size_t last) {
  for (std::size_t size = 0; size + last < text.size(); ++size)
    EXPECT_THROW(parse(text.substr(0, size), "cut"), Error) << size << " bytes of " << text;
}

// The last newline of a file may be missing, and so may the name of the solid at the end of an STL file. Any
// other cut is noticed.
TEST(CutFileTest, ACutFileIsRefused) {
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

TEST(CutFileTest, ACutObjIsRefusedOrASmallerMesh) {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\nl 4 1\n";
  for (std::size_t size = 0; size < text.size(); ++size) {
    try {
      const Mesh mesh = parse_obj(text.substr(0, size), "cut");
      EXPECT_EQ(mesh.points.size(), std::min<std::size_t>(4, (size + 2) / 8)) << size;
      EXPECT_LE(mesh.triangles.size(), 2);
    } catch (const Error&) {  // refused
    }
  }
}

}  // namespace
}  // namespace nearmiss::mesh_files
