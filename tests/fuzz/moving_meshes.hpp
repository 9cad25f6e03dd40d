// Moving meshes for tests of plans and trials, and the results of plans.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "fuzz/random.hpp"
#include "fuzz/scenes/plan.hpp"
#include "fuzz/scenes/scene.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

/// Small tetrahedra with integer coordinates. The first tetrahedron rests, the second moves as a whole, the
/// third changes its shape, the fourth rests, and so on.
inline MovingMesh tetrahedra(std::uint64_t seed, int count = 30) {
  Random random(seed, 0, 0);
  Mesh mesh;
  std::vector<Vector3<double>> end;
  for (int body = 0; body < count; ++body) {
    const int first = static_cast<int>(mesh.points.size());
    const Vector3<double> place = random.integer_vector(4);
    const Vector3<double> velocity = body % 3 == 0 ? Vector3<double>(0, 0, 0) : random.integer_vector(3);
    for (int i = 0; i < 4; ++i) {
      mesh.points.push_back(place + random.integer_vector(2));
      end.push_back(mesh.points.back() + velocity);
      if (body % 3 == 2) end.back() += random.integer_vector(1);
    }
    for (const auto& t : {std::array{0, 1, 2}, std::array{0, 1, 3}, std::array{0, 2, 3}, std::array{1, 2, 3}})
      mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return make_moving_mesh(std::move(mesh), std::move(end));
}

/// Two square grids of n by n squares. The upper grid falls through the lower one.
inline MovingMesh grids(int n) {
  Mesh mesh;
  std::vector<Vector3<double>> end;
  Random random(1, 0, 0);
  for (const double height : {0.0, 0.25}) {
    const int first = static_cast<int>(mesh.points.size());
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        mesh.points.emplace_back(i, j, height + random.uniform(-0.125, 0.125));
        end.emplace_back(i, j, random.uniform(-0.125, 0.125) - height);
      }
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const int corner = first + i * (n + 1) + j;
        mesh.triangles.push_back({corner, corner + 1, corner + n + 1});
        mesh.triangles.push_back({corner + 1, corner + n + 2, corner + n + 1});
      }
  }
  return make_moving_mesh(std::move(mesh), std::move(end));
}

/// A scene with one step, which is the motion of the mesh. The mesh must outlive the scene.
inline Scene scene_of(const MovingMesh& mesh) {
  return {.name = "grids",
          .mesh = {mesh.start, mesh.triangles, mesh.edges},
          .points = [&mesh](std::size_t frame) { return frame == 0 ? mesh.start : mesh.end; }};
}

/// How many of a plan's pairs have each PairFate (what the plan does with a pair), and which pairs collide.
/// The oracle decides the pairs about which the plan asks.
struct PlanOutcome {
  Funnels funnels;
  std::set<Candidate> colliding;
};

inline PlanOutcome follow(const MovingMesh& mesh, LeaveOut leave_out) {
  PlanOutcome result;
  result.funnels = follow_plan(
      Plan(mesh, leave_out),
      [&](const AskedPairs& pairs) {
        for (std::size_t i = 0; i < pairs.queries.size(); ++i)
          if (collides(pairs.queries[i])) result.colliding.insert(pairs.candidates[i]);
      },
      [&](const Candidate& candidate, const Query&, PairFate, bool hit) {
        if (hit) result.colliding.insert(candidate);
      },
      never_over);
  return result;
}

}  // namespace nearmiss
