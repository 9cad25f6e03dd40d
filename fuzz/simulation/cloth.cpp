#include "fuzz/simulation/cloth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "ccd/query/error.hpp"
#include "fuzz/scenes/built_in/formulas.hpp"

namespace nearmiss {

namespace {

/// Maps each edge of a triangle to the vertices opposite the edge, and each point on lines to its neighbours.
struct Opposites {
  std::map<std::array<int, 2>, std::vector<int>> of_edge;
  std::map<int, std::vector<int>> on_lines;

  explicit Opposites(const Mesh& mesh) {
    for (const auto& triangle : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [low, high] = std::minmax(triangle[i], triangle[(i + 1) % 3]);
        of_edge[{low, high}].push_back(triangle[(i + 2) % 3]);
      }
    for (const auto& [a, b] : mesh.lines) {
      on_lines[a].push_back(b);
      on_lines[b].push_back(a);
    }
  }
};

constexpr int iterations = 12;

}  // namespace

Cloth::Cloth(const Mesh& mesh, std::vector<bool> held, const Material& material, double step)
    : held_(std::move(held)), material_(material), step_(step) {
  constexpr double most = 1e10;
  if (!(material.stiffness * step * step <= most * material.mass()))
    throw Error(
        fmt::format("found springs of {:g} N/m with steps of {:g} s and points of {:g} kg, expected at most "
                    "{:.3g} N/m",
                    material.stiffness, step, material.mass(), most * material.mass() / (step * step)));
  add_springs(mesh);
  factorise();
}

void Cloth::add_springs(const Mesh& mesh) {
  const auto add = [&](int i, int j, double stiffness) {
    const auto at = [&](int point) { return mesh.points[static_cast<std::size_t>(point)]; };
    springs_.push_back({i, j, stiffness, length(at(i) - at(j))});
  };
  const Opposites opposites(mesh);
  const double bending = material_.bending * material_.stiffness;
  for (const auto& [edge, opposite] : opposites.of_edge) {
    add(edge[0], edge[1], material_.stiffness);
    if (opposite.size() == 2) add(opposite[0], opposite[1], bending);
  }
  for (const auto& [a, b] : mesh.lines) add(a, b, material_.stiffness);
  for (const auto& [point, neighbours] : opposites.on_lines)
    if (neighbours.size() == 2) add(neighbours[0], neighbours[1], bending);
}

void Cloth::factorise() {
  for (const bool is_held : held_) row_of_.push_back(is_held ? -1 : rows_++);
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < rows_; ++row) entries.emplace_back(row, row, material_.mass());
  for (const Spring& spring : springs_) {
    const double k = step_ * step_ * spring.stiffness;
    const int i = row_of_[static_cast<std::size_t>(spring.i)];
    const int j = row_of_[static_cast<std::size_t>(spring.j)];
    if (i >= 0) entries.emplace_back(i, i, k);
    if (j >= 0) entries.emplace_back(j, j, k);
    if (i >= 0 && j >= 0) entries.emplace_back(std::max(i, j), std::min(i, j), -k);
  }
  Eigen::SparseMatrix<double> matrix(rows_, rows_);
  matrix.setFromTriplets(entries.begin(), entries.end());
  factor_.compute(matrix);
  if (factor_.info() != Eigen::Success) throw Error("found springs that do not hold the cloth together");
}

Eigen::MatrixXd Cloth::right_side(const Eigen::MatrixXd& inertia, const PointVectors& at) const {
  Eigen::MatrixXd sum = inertia;
  for (const Spring& spring : springs_) {
    const double k = step_ * step_ * spring.stiffness;
    const auto i = static_cast<std::size_t>(spring.i);
    const auto j = static_cast<std::size_t>(spring.j);
    const Vector3<double> apart = at[i] - at[j];
    const double now = length(apart);
    const Vector3<double> at_rest = now > 0 ? Vector3<double>(apart * (spring.length / now)) : apart;
    // The position of a held neighbour is known, so its term is on the right-hand side.
    const auto add = [&](std::size_t point, std::size_t neighbour, const Vector3<double>& direction) {
      if (row_of_[point] < 0) return;
      const Vector3<double> known = held_[neighbour] ? Vector3<double>(at[neighbour] + direction) : direction;
      for (int axis = 0; axis < 3; ++axis) sum(row_of_[point], axis) += k * known[axis];
    };
    add(i, j, at_rest);
    add(j, i, -at_rest);
  }
  return sum;
}

PointVectors Cloth::advance(const PointVectors& start, const PointVectors& velocities,
                            const PointVectors& held_at, const std::function<void()>& check) const {
  const double kept = std::max(0.0, 1 - material_.drag * step_);
  const Vector3<double> fall(0, 0, -material_.gravity * step_ * step_);
  PointVectors at(start.size());
  Eigen::MatrixXd inertia(rows_, 3);
  for (std::size_t i = 0; i < start.size(); ++i) {
    at[i] = held_[i] ? held_at[i] : Vector3<double>(start[i] + step_ * kept * velocities[i] + fall);
    if (!held_[i])
      for (int axis = 0; axis < 3; ++axis) inertia(row_of_[i], axis) = material_.mass() * at[i][axis];
  }
  if (rows_ == 0) return at;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    check();
    const Eigen::MatrixXd solved = factor_.solve(right_side(inertia, at));
    for (std::size_t i = 0; i < at.size(); ++i)
      if (!held_[i])
        for (int axis = 0; axis < 3; ++axis) at[i][axis] = solved(row_of_[i], axis);
  }
  return at;
}

}  // namespace nearmiss
