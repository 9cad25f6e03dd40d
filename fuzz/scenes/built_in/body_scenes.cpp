// Scenes of rigid bodies.
#include <algorithm>
#include <cmath>

#include "fuzz/random.hpp"
#include "fuzz/scenes/built_in/formulas.hpp"
#include "fuzz/scenes/built_in/themes.hpp"

namespace nearmiss {

namespace {

/// The streams of random numbers from which these scenes are made.
enum : std::uint64_t { tumbling_motion = 301, flying_shapes, flying_places };

struct Pose {
  Rotation rotation;
  Vector3<double> place;
};

/// A scene of bodies. Body i has the shape with number i modulo the number of shapes.
Scene scene_of_bodies(std::size_t frames, const std::vector<Mesh>& shapes, int count,
                      const std::function<Pose(int body, double frame)>& pose) {
  const auto shape = [shapes](int body) -> const Mesh& {
    return shapes[static_cast<std::size_t>(body) % shapes.size()];
  };
  Mesh primitives;
  int first = 0;
  for (int body = 0; body < count; ++body) {
    add_triangles(primitives, shape(body), first);
    first += static_cast<int>(shape(body).points.size());
  }
  return scene_of_formula(frames, std::move(primitives), [=](double frame) {
    PointList points;
    points.reserve(static_cast<std::size_t>(first));
    for (int body = 0; body < count; ++body) {
      const Pose there = pose(body, frame);
      for (const auto& p : shape(body).points) points.push_back(there.rotation(p) + there.place);
    }
    return points;
  });
}

/// A rotation about a random axis.
Rotation any_rotation(Random& random, double turns) {
  const Vector3<double> way = random.vector(1);
  return {way / length(way), turns};
}

/// The number of bodies in a scene of a given size, and their shapes: cubes, balls and slabs.
struct Pieces {
  Pieces(int size, int half_a_side)
      : half(half_a_side),
        shapes{box({2 * half, 2 * half, 2 * half}), ball(2 * half), box({3 * half, 2 * half, half})} {
    double triangles = 0;
    for (const Mesh& shape : shapes) triangles += static_cast<double>(shape.triangles.size());
    count = nearest(size / (triangles / static_cast<double>(shapes.size())));
    while (row * row * row < count) ++row;
  }
  /// The cell of a body. The cells form a cube, which the bodies fill layer by layer.
  [[nodiscard]] std::array<int, 3> cell(int body) const {
    return {body % row, body / row % row, body / row / row};
  }

  int half;  ///< half the side of a cube
  std::vector<Mesh> shapes;
  int count = 0;
  int row = 1;  ///< cells along a side of the cube of bodies
};

/// Bodies turn about their own axes, and swing to and fro so that they hit each other.
Scene tumbling(int size) {
  const Pieces pieces(size, size < 800 ? 1 : 2);
  return scene_of_bodies(25, pieces.shapes, pieces.count, [=](int body, double frame) {
    Random random(0, tumbling_motion, static_cast<std::uint64_t>(body));
    const double turned = random.uniform();
    const double turning = random.uniform(0.01, 0.06) / pieces.half;
    const Rotation rotation = any_rotation(random, turned + turning * frame);
    Vector3<double> place;
    for (int i = 0; i < 3; ++i) {
      const double phase = random.uniform();
      place[i] = 3.3 * pieces.half * pieces.cell(body)[static_cast<std::size_t>(i)] +
                 0.6 * pieces.half * cos_sin(phase + 0.04 * frame).sin;
    }
    return Pose{rotation, place};
  });
}

/// Rounds coordinates to multiples of 2^-20, whose sums are exact.
Vector3<double> on_grid(const Vector3<double>& p) {
  const auto rounded = [](double x) { return std::floor(x * 0x1p20 + 0.5) * 0x1p-20; };
  return {rounded(p[0]), rounded(p[1]), rounded(p[2])};
}

/// Layers of bodies pass each other. Each layer moves in its own direction, without rotation. All coordinates
/// are multiples of 2^-20, so in a step all points of a layer move by exactly the same vector, and every pair
/// is at relative rest or in relative translation.
Scene flying(int size) {
  const Pieces pieces(size, 1);
  std::vector<Mesh> shapes;
  for (std::uint64_t i = 0; i < 9; ++i) {
    Random random(0, flying_shapes, i);
    const double turns = random.uniform();
    const Rotation rotation = any_rotation(random, turns);
    shapes.push_back(pieces.shapes[i % 3]);
    for (auto& p : shapes.back().points) p = on_grid(rotation(p));
  }
  return scene_of_bodies(21, shapes, pieces.count, [=](int body, double frame) {
    Random random(0, flying_places, static_cast<std::uint64_t>(body));
    const auto cell = pieces.cell(body);
    const Vector3<double> start(3.6 * cell[0], 3.6 * cell[1], 2.7 * cell[2]);
    const CosSin way = cos_sin(0.31 * cell[2]);
    const Vector3<double> velocity = on_grid({0.4 * way.cos, 0.4 * way.sin, 0});
    return Pose{{}, on_grid(start + random.vector(0.3)) + velocity * frame};
  });
}

/// One brick is pulled out of a wall of bricks that are 1/32 apart. All other bricks are at rest.
Scene resting(int size) {
  const Mesh brick = box({4, 2, 2});
  const int count = nearest(size / static_cast<double>(brick.triangles.size()));
  const int row = std::max(1, nearest(0.7 * std::sqrt(static_cast<double>(count))));
  const int disturbed = std::max(0, count - row - (row + 1) / 2);
  return scene_of_bodies(15, {brick}, count, [=](int body, double frame) {
    constexpr double gap = 0x1p-5;
    const int layer = body / row;
    const Vector3<double> place((body % row + layer % 2 / 2.0) * (4 + gap), 0, layer * (2 + gap));
    if (body != disturbed) return Pose{{}, place};
    return Pose{{{0, 0, 1}, 0.004 * frame}, place + Vector3<double>(0.02, 0.2, 0.005) * frame};
  });
}

}  // namespace

std::vector<BuiltInScene> body_scenes() {
  constexpr int largest = 4'000'000;
  return {{"tumbling", "rigid bodies turn and hit each other", 5000, 100, largest, tumbling},
          {"flying", "bodies pass by each other, without turning", 5000, 100, largest, flying},
          {"resting", "a wall of bricks at rest, of which one is pulled out", 5000, 200, largest, resting}};
}

}  // namespace nearmiss
