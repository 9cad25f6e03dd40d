#include "fuzz/simulation/simulation.hpp"

#include <algorithm>
#include <utility>

#include "fuzz/scenes/built_in/formulas.hpp"

namespace nearmiss {

namespace {

/// Even if a simulation explodes, its results report at most this energy, 100 kJ.
constexpr double most_picojoules = 1e17;

/// The number of rounds that apply impulses. These rounds come before the rounds that move impact zones.
constexpr int impulse_rounds = 10;
/// The number of rounds that move impact zones. After these rounds, one more round only asks the CCD.
constexpr int zone_rounds = 20;

/// The groups of points that the lines of a mesh join. Points on no line are left out.
std::vector<std::vector<int>> groups(const Mesh& joined) {
  const Bodies found = bodies(joined);
  std::vector<std::vector<int>> all(static_cast<std::size_t>(found.count));
  for (std::size_t i = 0; i < found.of_point.size(); ++i)
    all[static_cast<std::size_t>(found.of_point[i])].push_back(static_cast<int>(i));
  std::erase_if(all, [](const std::vector<int>& group) { return group.size() == 1; });
  return all;
}

Mesh in_metres(Mesh mesh, double edge) {
  for (auto& point : mesh.points) point *= edge;
  return mesh;
}

}  // namespace

Simulation::Simulation(SimulatedScene scene, const Material& material, double step, int steps_per_frame)
    : scene_(std::move(scene)),
      material_(material),
      step_(step),
      steps_per_frame_(steps_per_frame),
      response_(scene_.held, material),
      velocities_(scene_.held.size(), Vector3<double>(0, 0, 0)) {
  Mesh mesh = in_metres(scene_.scene.mesh, material.edge);
  cloth_ = std::make_shared<const Cloth>(mesh, scene_.held, material, step);
  auto end = mesh.points;
  motion_ = make_moving_mesh(std::move(mesh), std::move(end));
}

std::size_t Simulation::steps() const {
  return scene_.scene.steps() * static_cast<std::size_t>(steps_per_frame_);
}

/// The positions of held points after a step, interpolated between two frames. After the last frame, held
/// points stay at their positions in that frame.
PointVectors Simulation::held_positions(std::size_t step) const {
  const auto count = static_cast<std::size_t>(steps_per_frame_);
  const std::size_t frame = std::min((step + 1) / count, scene_.scene.steps());
  const double part =
      frame == scene_.scene.steps() ? 0 : static_cast<double>((step + 1) % count) / steps_per_frame_;
  PointVectors at = scene_.scene.points(frame);
  if (part > 0) {
    const PointVectors next = scene_.scene.points(frame + 1);
    for (std::size_t i = 0; i < at.size(); ++i) at[i] += part * (next[i] - at[i]);
  }
  for (auto& point : at) point *= material_.edge;
  return at;
}

void Simulation::repel(const Stop& stop) {
  MovingMesh near = motion_;
  near.end = near.start;
  near.separation = material_.thickness * material_.edge;
  find_candidates(
      near, [&](const Candidate& pair) { response_.repel(pair, motion_.start, motion_.end); },
      [&] { return stop.is_due(); });
}

void Simulation::resolve(const AskCcd& ask, SimulatedStep& done) {
  const auto at = [](int point) { return static_cast<std::size_t>(point); };
  /// A mesh whose lines join the points of each zone.
  Mesh zones{.points = motion_.start, .triangles = {}, .lines = {}};
  std::vector<bool> moved(scene_.held.size(), true);
  const auto asked = [&](const Candidate& pair) {
    const auto& all = pair.vertices;
    return std::any_of(all.begin(), all.end(), [&](int i) { return moved[at(i)]; }) &&
           !std::all_of(all.begin(), all.end(), [&](int i) { return scene_.held[at(i)]; });
  };
  for (int round = 0;; ++round) {
    const std::vector<ReportedPair> reported = ask(motion_, asked);
    ++done.rounds;
    done.unresolved = reported.size();
    if (reported.empty() || round == impulse_rounds + zone_rounds) return;
    const PointVectors before = motion_.end;
    if (round < impulse_rounds) {
      for (const ReportedPair& each : reported)
        response_.stop_approach(each.pair, each.time, motion_.start, motion_.end);
    } else {
      for (const ReportedPair& each : reported)
        for (const int point : each.pair.vertices) zones.lines.push_back({each.pair.vertices[0], point});
      for (const auto& zone : groups(zones)) response_.move_rigidly(zone, motion_.start, motion_.end);
    }
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] = motion_.end[i] != before[i];
    for (const ReportedPair& each : reported)
      for (const int point : each.pair.vertices) moved[at(point)] = true;
  }
}

double Simulation::kinetic_energy() const {
  double sum = 0;
  for (std::size_t i = 0; i < velocities_.size(); ++i)
    if (!scene_.held[i]) sum += dot(velocities_[i], velocities_[i]);
  return material_.mass() * sum / 2;
}

SimulatedStep Simulation::advance(const AskCcd& ask, const Stop& stop) {
  motion_.start = motion_.end;
  motion_.end = cloth_->advance(motion_.start, velocities_, held_positions(done_++), [&] { stop.check(); });
  repel(stop);
  stop.check();
  SimulatedStep done;
  resolve(ask, done);
  for (std::size_t i = 0; i < velocities_.size(); ++i)
    velocities_[i] = (motion_.end[i] - motion_.start[i]) / step_;
  tangled_ = find_tangled(motion_);
  done.tangled = tangled_.size();
  done.picojoules = static_cast<std::uint64_t>(std::min(most_picojoules, 1e12 * kinetic_energy()));
  return done;
}

}  // namespace nearmiss
