// Meshes and their candidate pairs.
#include "fuzz/scenes/candidates.hpp"
#include "fuzz/scenes/scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "ccd/error.hpp"
#include "fuzz/random.hpp"
#include "oracle/filter/box.hpp"
#include "tests/temporary_folder.hpp"

namespace nearmiss {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class MeshTest : public testing::TemporaryFolder {
 protected:
  void expect_refused(const std::string& text, const std::string& message) const {
    const auto path = write("mesh.obj", text);
    EXPECT_THAT([&] { read_mesh(path); }, ThrowsMessage<Error>(HasSubstr(path.string() + message)));
  }
};

constexpr const char* square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST_F(MeshTest, ReadsVerticesAndFaces) {
  const Mesh mesh = read_mesh(write("a.obj",
                                    "# a comment\r\nv 0.1 -2e-3 4\r\nv 1 0 0\r\nv 0 1 0\r\nvn 0 0 1\r\n"
                                    "vt 0 0\r\nf 1/1/1 2//1 3\r\n"));
  ASSERT_EQ(mesh.points.size(), 3);
  EXPECT_EQ(mesh.points[0], Vector3<double>(0.1, -2e-3, 4));
  EXPECT_THAT(mesh.triangles, ElementsAre(std::array{0, 1, 2}));
}

TEST_F(MeshTest, CoordinatesAreReadToTheLastBit) {
  const Mesh mesh =
      read_mesh(write("a.obj", "v 0.087606608360884852 0.1 1e-310\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  EXPECT_EQ(mesh.points[0], Vector3<double>(0.087606608360884852, 0.1, 1e-310));
}

TEST_F(MeshTest, AnyBlanksSeparate) {
  const std::string long_word = "3/" + std::string(300, '0') + "1";
  const Mesh mesh =
      read_mesh(write("a.obj", "v\t0 0\t 0\nv 1 0 0\n v 0 1 0\nf 1\t2/1/1\t" + long_word + "\n"));
  EXPECT_EQ(mesh.points[2], Vector3<double>(0, 1, 0));
  EXPECT_THAT(mesh.triangles, ElementsAre(std::array{0, 1, 2}));
}

TEST_F(MeshTest, PolygonsBecomeTriangles) {
  const Mesh mesh = read_mesh(write("a.obj", std::string(square) + "f 1 2 3 4\n"));
  EXPECT_THAT(mesh.triangles, ElementsAre(std::array{0, 1, 2}, std::array{0, 2, 3}));
}

TEST_F(MeshTest, NegativeNumbersCountBackwards) {
  const Mesh mesh = read_mesh(write("a.obj", std::string(square) + "f -4 -2 -1\n"));
  EXPECT_THAT(mesh.triangles, ElementsAre(std::array{0, 2, 3}));
}

TEST_F(MeshTest, BadInputIsNamedWithItsLine) {
  expect_refused(std::string(square) + "f 1 2 5\n", ":5: found vertex 5 in a face, expected at most 4");
  expect_refused(std::string(square) + "f 1 2 0\n", ":5: found vertex 0 in a face");
  expect_refused(std::string(square) + "f 1 2 -5\n", ":5: found vertex -5 in a face");
  expect_refused(std::string(square) + "f 1 2\n", ":5: found a face of 2 vertices");
  expect_refused(std::string(square) + "f 1 2 x\n", ":5: found 'x' in a face");
  expect_refused("v 0 0 0\nv 0 nan 0\nf 1 1 1\n", ":2: found 'nan', expected a finite number");
  expect_refused("v 0 0\n", ":1: found 2 coordinates of a vertex");
  expect_refused(std::string(square) + "l 1 5\n", ":5: found vertex 5 in a polyline, expected at most 4");
  expect_refused(std::string(square) + "l 1\n", ":5: found a polyline of 1 vertices, expected at least 2");
  expect_refused("", ": found no vertex");
  expect_refused(std::string(square) + "f 1 2 3\nrubbish\n",
                 ":6: found 'rubbish', expected a line of the OBJ format");
  EXPECT_THAT([&] { read_mesh(file("none.obj")); },
              ThrowsMessage<Error>(HasSubstr("none.obj: cannot be read")));
}

TEST_F(MeshTest, BothMeshesMustMatch) {
  const auto start = write("start.obj", std::string(square) + "f 1 2 3\n");
  const auto expect_mismatch = [&](const std::string& text, const std::string& message) {
    const auto end = write("end.obj", text);
    EXPECT_THAT([&] { scene_of_files(start, end); }, ThrowsMessage<Error>(HasSubstr(end.string() + message)));
  };
  expect_mismatch("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", ": found 3 vertices, expected 4");
  expect_mismatch(std::string(square) + "f 1 2 3 4\n", ": found 2 triangles, expected 1");
  expect_mismatch(std::string(square) + "f 1 3 2\n", ": found triangle 1 of vertices 1 3 2, expected 1 2 3");
}

class FolderTest : public testing::TemporaryFolder {
 protected:
  /// A frame of one triangle, at a height.
  void write_frame(const std::string& name, double height) const {
    const std::string z = std::to_string(height);
    write("frames/" + name, "v 0 0 " + z + "\nv 1 0 " + z + "\nv 0 1 " + z + "\nf 1 2 3\n");
  }
  void expect_refused(const std::string& message) const {
    EXPECT_THAT([&] { scene_of_folder(file("frames")); },
                ThrowsMessage<Error>(HasSubstr(file("frames").string() + message)));
  }
};

TEST_F(FolderTest, FramesAreInTheOrderOfTheirNumbers) {
  const std::vector<std::string> names{"a1_0.obj",
                                       "a1_1.OBJ",
                                       "a1_2.obj",
                                       "a1_02.obj",
                                       "a1_10.obj",
                                       "a2_1.obj",
                                       "a10.obj",
                                       "a10_9.obj",
                                       "b.obj",
                                       "b18446744073709551616.obj",
                                       "b18446744073709551617.obj"};
  for (std::size_t i = names.size(); i-- > 0;) write_frame(names[i], static_cast<double>(i));
  const Scene scene = scene_of_folder(file("frames"));
  EXPECT_EQ(scene.name, "frames");
  ASSERT_EQ(scene.frames, names.size());
  std::vector<double> heights;
  for (std::size_t i = 0; i < scene.frames; ++i) heights.push_back(scene.points(i)[0][2]);
  EXPECT_THAT(heights, ElementsAre(0, 1, 3, 2, 4, 5, 6, 7, 8, 9, 10));  // 02 is 2, and 0 comes before 2
  EXPECT_EQ(scene_of_folder(file("frames") / "").name, "frames");
  EXPECT_EQ(scene_of_folder(file("frames") / ".").name, "frames");
}

TEST_F(FolderTest, WhatIsNoMeshIsPassedOver) {
  write_frame("1.obj", 0);
  write_frame("2.obj", 1);
  write("frames/readme.txt", "notes");
  write("frames/picture.png", "");
  write("frames/.3.obj", "rubbish");
  write("frames/4.obj/5.obj", "rubbish");
  EXPECT_EQ(scene_of_folder(file("frames")).frames, 2);
}

TEST_F(FolderTest, AFrameOfAnotherMeshIsNamedWhenItIsRead) {
  write_frame("1.obj", 0);
  write_frame("2.obj", 1);
  write("frames/3.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 3 2 1\n");
  write("frames/4.obj", "v 0 0 0\n");
  const Scene scene = scene_of_folder(file("frames"));
  EXPECT_EQ(scene.points(1)[2], Vector3<double>(0, 1, 1));
  EXPECT_THAT(
      [&] { scene.points(2); },
      ThrowsMessage<Error>(HasSubstr("3.obj: found triangle 1 of vertices 3 2 1, expected 1 2 3 as in")));
  EXPECT_THAT([&] { scene.points(3); },
              ThrowsMessage<Error>(HasSubstr("4.obj: found 1 vertices, expected 3 as in")));
}

TEST_F(FolderTest, TwoFramesWithOneEndingAreNeeded) {
  expect_refused(": cannot be read as a folder");
  write("frames/readme.txt", "notes");
  expect_refused(": found 0 files with a mesh, expected at least 2");
  write_frame("1.obj", 0);
  expect_refused(": found 1 files with a mesh, expected at least 2");
  write("frames/2.off", "OFF\n1 0 0\n0 0 0\n");
  expect_refused(": found 1.obj and 2.off, expected meshes with one ending");
}

/// Points 0 and 2 are in one place at frame 0, and so are 1 and 4.
Scene with_seams(const std::vector<Vector3<double>>& later) {
  const Mesh mesh{
      {{0, 0, 0}, {1, 0, 0}, {-0.0, 0, -0.0}, {0, 1, 0}, {1, 0, 0}}, {{0, 1, 3}, {2, 4, 1}}, {{2, 3}}};
  return {"seams", 2, mesh, [=](std::size_t frame) { return frame == 0 ? mesh.points : later; }};
}

TEST(Welded, EqualPointsBecomeOne) {
  const Scene scene = welded(with_seams({{5, 0, 0}, {6, 0, 0}, {5, 0, 0}, {7, 0, 0}, {6, 0, 0}}));
  EXPECT_THAT(scene.mesh.points,
              ElementsAre(Vector3<double>(0, 0, 0), Vector3<double>(1, 0, 0), Vector3<double>(0, 1, 0)));
  EXPECT_THAT(scene.mesh.triangles, ElementsAre(std::array{0, 1, 2}, std::array{0, 1, 1}));
  EXPECT_THAT(scene.mesh.lines, ElementsAre(std::array{0, 2}));
  EXPECT_EQ(scene.points(0), scene.mesh.points);
  EXPECT_THAT(scene.points(1),
              ElementsAre(Vector3<double>(5, 0, 0), Vector3<double>(6, 0, 0), Vector3<double>(7, 0, 0)));
}

TEST(Welded, WhatIsTornApartIsRefused) {
  const Scene scene = welded(with_seams({{5, 0, 0}, {6, 0, 0}, {5, 0, 0}, {7, 0, 0}, {6, 0, 1e-300}}));
  EXPECT_THAT([&] { scene.points(1); },
              ThrowsMessage<Error>(HasSubstr("seams, frame 1: found vertices 2 and 5 apart")));
}

TEST_F(MeshTest, EveryEdgeIsThereOnce) {
  const auto path = write("a.obj", std::string(square) + "f 1 2 3 4\nf 4 4 1\n");
  EXPECT_THAT(
      moving_mesh(scene_of_files(path, path), 0).edges,
      ElementsAre(std::array{0, 1}, std::array{0, 2}, std::array{0, 3}, std::array{1, 2}, std::array{2, 3}));
}

MovingMesh random_mesh(std::uint64_t seed, int points, int triangles) {
  Random random(seed, 0, 0);
  std::vector<Vector3<double>> start;
  std::vector<Vector3<double>> end;
  std::vector<std::array<int, 3>> faces;
  for (int i = 0; i < points; ++i) {
    start.push_back(random.integer_vector(6));
    end.push_back(start.back() + random.integer_vector(1));
  }
  for (int i = 0; i < triangles; ++i) {
    const int a = random.integer(0, points - 4);
    faces.push_back({a, a + 1, a + random.integer(2, 3)});
  }
  return make_moving_mesh({start, faces, {}}, end);
}

/// All pairs, one by one.
std::multiset<Candidate> by_brute_force(const MovingMesh& mesh) {
  std::multiset<Candidate> found;
  const auto add = [&](const Candidate& candidate) {
    std::array<int, 4> sorted = candidate.vertices;
    std::sort(sorted.begin(), sorted.end());
    const auto middle = candidate.vertices.begin() + split(candidate.kind);
    const bool shared =
        std::find_first_of(candidate.vertices.begin(), middle, middle, candidate.vertices.end()) != middle;
    if (!shared && boxes_meet(make_query(mesh, candidate))) found.insert(candidate);
  };
  for (int v = 0; v < static_cast<int>(mesh.start.size()); ++v)
    for (const auto& t : mesh.triangles) add({Kind::vertex_triangle, {v, t[0], t[1], t[2]}});
  for (auto e = mesh.edges.begin(); e != mesh.edges.end(); ++e)
    for (auto f = e + 1; f != mesh.edges.end(); ++f)
      add({Kind::edge_edge, {(*e)[0], (*e)[1], (*f)[0], (*f)[1]}});
  return found;
}

// Integer coordinates: many boxes only touch.
TEST(Scene, FindsExactlyThePairsWhoseSweptBoxesMeet) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const MovingMesh mesh = random_mesh(seed, 60, 80);
    std::multiset<Candidate> found;
    find_candidates(mesh, [&](const Candidate& candidate) { found.insert(candidate); });
    const auto expected = by_brute_force(mesh);
    EXPECT_GT(expected.size(), 100);
    EXPECT_TRUE(found == expected) << "seed " << seed << ": " << found.size() << " instead of "
                                   << expected.size();
  }
}

TEST(Scene, TheSweepFindsTheSamePairs) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const MovingMesh mesh = random_mesh(seed, 60, 80);
    for (const Kind kind : kinds) {
      std::multiset<Candidate> by_boxes;
      std::multiset<Candidate> by_sweep;
      const auto never = [] { return false; };
      const auto sharing = find_candidates(
          mesh, kind, [&](const Candidate& each) { by_boxes.insert(each); }, never);
      EXPECT_EQ(find_candidates_by_sweep(
                    mesh, kind, [&](const Candidate& each) { by_sweep.insert(each); }, never),
                sharing);
      EXPECT_TRUE(by_boxes == by_sweep) << "seed " << seed;
    }
  }
}

TEST(Scene, AMeshOfOneTriangleHasNoPair) {
  const MovingMesh mesh = make_moving_mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}},
                                           {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  find_candidates(mesh, [](const Candidate&) { FAIL(); });
}

}  // namespace
}  // namespace nearmiss
