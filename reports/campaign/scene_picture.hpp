// A picture of a scene: its primitives at t = 0 and t = 1, with marks.
#pragma once

#include <string>

namespace nearmiss {

/// The picture is JSON, because only a page reads it:
///   meanings   entry i says what bit i of a mark means: "collides" and so on
///   primitives the number of primitives of the step; a large picture leaves some of them out
///   points     x y z at t = 0 and x y z at t = 1, one after the other, as integers with blanks between them,
///              scaled equally along all axes so that all are within 0 and 9999
///   triangles  three points and a mark, one after the other; lines: two and a mark; dots: one and a mark
struct ScenePicture {
  std::string step;  ///< "scene:NAME" or "scene:NAME#STEP"
  std::string json;

  bool operator==(const ScenePicture&) const = default;
};

}  // namespace nearmiss
