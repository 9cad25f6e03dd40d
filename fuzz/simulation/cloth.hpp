// Cloth and hair as masses and springs, moved by implicit integration that ignores contacts.
#pragma once

#include <Eigen/SparseCholesky>

#include <functional>
#include <vector>

#include "fuzz/meshes/mesh.hpp"
#include "fuzz/simulation/material.hpp"

namespace nearmiss {

/// Points and springs. Each edge of a mesh is a spring. Weaker springs resist bending: they join the two
/// vertices that are opposite an edge in its two triangles, and the two neighbours of a point of a hair. All
/// springs are at rest in the given mesh.
///
/// A step uses the backward Euler method. Its equations are solved alternately for the directions of all
/// springs and for the positions of all points (Liu, Bargteil, O'Brien, Kavan 2013, "Fast simulation of
/// mass-spring systems"). The matrix of the equations for the positions is constant and positive definite.
/// The alternation converges more slowly for stiffer cloth.
class Cloth {
 public:
  /// `held` says for each point whether the caller moves it. `step` is in seconds. Throws Error if the
  /// stiffness times the square of the step is more than 10^10 times the mass of a point, because double is
  /// too coarse for such springs.
  Cloth(const Mesh& mesh, std::vector<bool> held, const Material& material, double step);

  /// The positions after a step that begins at the positions `start` (in m) with `velocities` (in m/s). Held
  /// points move to their positions in `held_at`. Calls `check` now and then; an exception from `check` ends
  /// the work.
  [[nodiscard]] PointVectors advance(
      const PointVectors& start, const PointVectors& velocities, const PointVectors& held_at,
      const std::function<void()>& check = [] {}) const;

 private:
  struct Spring {
    int i, j;
    double stiffness, length;
  };

  void add_springs(const Mesh& mesh);
  void factorise();
  [[nodiscard]] Eigen::MatrixXd right_side(const Eigen::MatrixXd& inertia, const PointVectors& at) const;

  std::vector<bool> held_;
  Material material_;
  double step_;
  std::vector<Spring> springs_;
  std::vector<int> row_of_;  ///< for each point, the number of its row in the matrix; -1 for held points
  int rows_ = 0;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace nearmiss
