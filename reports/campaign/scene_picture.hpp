// A picture of a scene: its primitives at t = 0 and t = 1, with marks.
#pragma once

#include <string>

namespace nearmiss {

/// The picture of one step, as a JSON object for the page. The members of the object:
///   meanings   entry i says what bit i of a mark means: "collides" and so on
///   primitives the number of primitives of the step; a large picture leaves some of them out
///   points     for each point, x y z at t = 0 and x y z at t = 1: integers from 0 to 9999, separated by
///              blanks and scaled equally along all axes
///   triangles  for each triangle, three indices of points and a mark
///   lines      for each line, two indices of points and a mark
///   dots       for each dot, an index of a point and a mark
struct ScenePicture {
  std::string step;  ///< "scene:NAME" or "scene:NAME#STEP"
  std::string json;

  bool operator==(const ScenePicture&) const = default;
};

}  // namespace nearmiss
