// Scenes from files: two meshes, or a folder of frames.
#include "fuzz/scenes/scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/refused.hpp"
#include "tests/temporary_folder.hpp"

namespace nearmiss {
namespace {

using ::testing::ElementsAre;

class TwoFilesTest : public testing::TemporaryFolder {};

TEST_F(TwoFilesTest, MustHoldTheSamePrimitives) {
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const auto start = write("start.obj", square + "f 1 2 3\n");
  const auto expect_mismatch = [&](const std::string& text, const std::string& message) {
    const auto end = write("end.obj", text);
    EXPECT_REFUSED(scene_of_files(start, end), end.string() + message);
  };
  expect_mismatch("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", ": found 3 vertices, expected 4");
  expect_mismatch(square + "f 1 2 3 4\n", ": found 2 triangles, expected 1");
  expect_mismatch(square + "f 1 3 2\n", ": found triangle 1 of vertices 1 3 2, expected 1 2 3");
}

class FolderTest : public testing::TemporaryFolder {
 protected:
  void write_frame(const std::string& name, double height) const {
    const std::string z = std::to_string(height);
    write("frames/" + name, "v 0 0 " + z + "\nv 1 0 " + z + "\nv 0 1 " + z + "\nf 1 2 3\n");
  }
  void expect_refused(const std::string& message) const {
    EXPECT_REFUSED(scene_of_folder(file("frames")), file("frames").string() + message);
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
  // The number 02 in a name counts as 2. Of two names with equal numbers, a1_02 comes before a1_2, because
  // the character 0 comes before the character 2.
  EXPECT_THAT(heights, ElementsAre(0, 1, 3, 2, 4, 5, 6, 7, 8, 9, 10));
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
  EXPECT_REFUSED(scene.points(2), "3.obj: found triangle 1 of vertices 3 2 1, expected 1 2 3 as in");
  EXPECT_REFUSED(scene.points(3), "4.obj: found 1 vertices, expected 3 as in");
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

/// A scene in which points 0 and 2 coincide in frame 0, and points 1 and 4, too.
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
  EXPECT_REFUSED(scene.points(1), "seams, frame 1: found vertices 2 and 5 apart");
}

}  // namespace
}  // namespace nearmiss
