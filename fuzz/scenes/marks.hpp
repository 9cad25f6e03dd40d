// Marks on the primitives of a step, and a picture of the marked primitives.
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

/// Marks the primitives of pairs that collide, and of pairs that a subject misses or falsely reports.
class Marks {
 public:
  void add_collision(const Candidate& candidate);
  /// Marks a pair that collides, or that the subject with this index misses or falsely reports. The 16th and
  /// later subjects leave no mark of their own.
  void add(const Candidate& candidate, std::size_t subject, const Outcome& outcome);
  /// Marks an edge and a triangle that pass through each other.
  void add_tangled(const std::array<int, 2>& edge, const std::array<int, 3>& triangle);
  void merge(const Marks& other);

  /// The number of marked primitives.
  [[nodiscard]] std::size_t size() const { return triangles_.size() + edges_.size() + points_.size(); }

  /// The number of primitives that belong to a pair that some subject misses.
  [[nodiscard]] std::size_t missed() const;

  /// The picture of a step; `subjects` has the names of the subjects. Triangles also show the marks of their
  /// edges. The picture has at most 8,000 primitives with a mark, and at most 8,000 without.
  [[nodiscard]] ScenePicture picture(const std::string& step, const MovingMesh& mesh,
                                     const std::vector<std::string>& subjects) const;

 private:
  using Mark = std::uint32_t;
  struct Primitives;

  void add(const Candidate& candidate, Mark mark);
  void add_surfaces(const MovingMesh& mesh, Primitives& primitives) const;
  void add_points(const MovingMesh& mesh, Primitives& primitives) const;

  std::map<std::array<int, 3>, Mark> triangles_;
  std::map<std::array<int, 2>, Mark> edges_;
  std::map<int, Mark> points_;
};

}  // namespace nearmiss
