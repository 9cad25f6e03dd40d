// Tests which primitives of a scene the picture of a step shows and marks.
#include "fuzz/scenes/marks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "reports/text/json.hpp"

namespace nearmiss {
namespace {

constexpr int most = 8000;

MovingMesh row_of_points(int count) {
  Mesh mesh;
  for (int i = 0; i < count; ++i) mesh.points.emplace_back(i, 0, 0);
  auto end = mesh.points;
  return make_moving_mesh(std::move(mesh), std::move(end));
}

/// The marks of the dots in a picture; 0 stands for no mark. The picture's JSON has two numbers for each dot:
/// the index of its point, and its mark.
std::vector<int> marks_of_dots(const ScenePicture& picture) {
  const auto json = nlohmann::json::parse(picture.json);
  std::istringstream text(json["dots"].get<std::string>());
  std::vector<int> marks;
  for (int point = 0, mark = 0; text >> point >> mark;) marks.push_back(mark);
  return marks;
}

ScenePicture picture_of(int points, int marked) {
  Marks marks;
  for (int i = 0; i < marked; ++i) marks.add_collision({Kind::vertex_triangle, {i, i, i, i}});
  return marks.picture("step", row_of_points(points), {});
}

TEST(Marks, APictureShowsEightThousandPrimitivesOfEachSortAtMost) {
  const ScenePicture picture = picture_of(2 * most + 20, most + 10);
  EXPECT_EQ(nlohmann::json::parse(picture.json)["primitives"], 2 * most + 20);
  const auto marks = marks_of_dots(picture);
  EXPECT_EQ(std::ranges::count(marks, 1), most);
  EXPECT_EQ(std::ranges::count(marks, 0), most);
}

}  // namespace
}  // namespace nearmiss
