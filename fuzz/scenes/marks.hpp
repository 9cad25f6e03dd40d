// What is said of the primitives of a step, and a picture of it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "fuzz/scenes/candidates.hpp"
#include "reports/campaign/scene_picture.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// Primitives in pairs that collide, or of which a subject says so falsely, or misses that they do.
class Marks {
 public:
  void add_collision(const Candidate& candidate) { add(candidate, 1); }
  /// What a subject said, by its place among the subjects; from the 16th on nothing is noted.
  void add(const Candidate& candidate, std::size_t subject, const Outcome& outcome);
  void merge(const Marks& other);

  /// How many primitives are marked.
  [[nodiscard]] std::size_t size() const { return triangles_.size() + edges_.size() + points_.size(); }

  /// Of a step; `subjects` are the names. Triangles have the marks of their edges too. Of primitives with a
  /// mark, and of those without, as many are shown as a page can bear.
  [[nodiscard]] ScenePicture picture(const std::string& step, const MovingMesh& mesh,
                                     const std::vector<std::string>& subjects) const;

 private:
  using Mark = std::uint32_t;

  void add(const Candidate& candidate, Mark mark);

  std::map<std::array<int, 3>, Mark> triangles_;
  std::map<std::array<int, 2>, Mark> edges_;
  std::map<int, Mark> points_;
};

}  // namespace nearmiss
