// Scenes of cloth: a cloth on spikes, sheets that slide over each other, and points that fall through a
// surface.
#include <algorithm>
#include <cmath>

#include "fuzz/random.hpp"
#include "fuzz/scenes/built_in/formulas.hpp"
#include "fuzz/scenes/built_in/themes.hpp"

namespace nearmiss {

namespace {

/// The streams of random numbers from which these scenes are made.
enum : std::uint64_t { spikes_gaps = 101, spikes_waves, sheets_waves, points_places, points_waves };

// --- spikes -----------------------------------------------------------------------------------------------

constexpr int spike_sides = 12, spike_rings = 4;
constexpr int spike_triangles = spike_sides * (2 * spike_rings - 1);
// The distance between neighbouring spikes. At this distance, the cloth has 200 triangles for each spike.
constexpr double pitch = 10;
constexpr double tip = 5;  // the height of a spike

/// The height of a spike at a distance from its axis. A spike is a cone with a round tip, and the cloth on it
/// has the same shape.
double spike_height(double distance) { return tip - 1.5 * (std::sqrt(distance * distance + 1) - 1); }

void add_spike(Mesh& mesh, int first) {
  for (int i = 0; i < spike_sides; ++i)
    mesh.triangles.push_back({first, first + 1 + i, first + 1 + (i + 1) % spike_sides});
  add_surface(mesh, first + 1, spike_rings, spike_sides, true);
}

void add_spike_points(PointList& points, double x, double y) {
  points.emplace_back(x, y, spike_height(0));
  for (int ring = 1; ring <= spike_rings; ++ring)
    for (int i = 0; i < spike_sides; ++i) {
      const CosSin around = cos_sin(static_cast<double>(i) / spike_sides);
      points.emplace_back(x + ring * around.cos, y + ring * around.sin, spike_height(ring));
    }
}

/// Rows of spikes around the origin, and the gap between each spike and the cloth above it.
class SpikeField {
 public:
  explicit SpikeField(int row) : row_(row) {
    for (int i = 0; i < row * row; ++i)
      gaps_.push_back(Random(0, spikes_gaps, static_cast<std::uint64_t>(i)).uniform(0.02, 0.35));
  }

  /// The x coordinate of the spikes in column i, which is also the y coordinate of the spikes in row i.
  [[nodiscard]] double place(int i) const { return (i - middle_) * pitch; }

  /// The height at which the spike nearest to (x, y) holds up the cloth.
  [[nodiscard]] double held_height(double x, double y) const {
    const int i = nearest_spike(x);
    const int j = nearest_spike(y);
    const double dx = x - place(i);
    const double dy = y - place(j);
    return spike_height(std::sqrt(dx * dx + dy * dy)) + gaps_[static_cast<std::size_t>(j * row_ + i)];
  }

 private:
  [[nodiscard]] int nearest_spike(double at) const {
    return std::clamp(nearest(at / pitch + middle_), 0, row_ - 1);
  }

  int row_;
  double middle_ = (row_ - 1) / 2.0;
  std::vector<double> gaps_;
};

/// A cloth falls on a square of spikes, by 0.2 in each step, from a height of 5.6 to a height of 1.6. The
/// tips of the spikes are at a height of 5. Each spike holds up the cloth with a random gap; some gaps are
/// too small, so collisions occur. A larger scene has more spikes of the same size and spacing.
Scene spikes(int size) {
  const double triangles_of_one = 2 * pitch * pitch + spike_triangles;
  const int row = std::max(1, nearest(std::sqrt(size / triangles_of_one)));
  const int squares = nearest(std::sqrt((size - row * row * spike_triangles) / 2.0));
  const auto cloth = [field = SpikeField(row), waves = Waves(spikes_waves, 0, 0.02)](double x, double y,
                                                                                     double frame) {
    const double falling = tip + 0.6 - 0.2 * frame;
    return Vector3<double>(x, y, smooth_max(falling, field.held_height(x, y), 0.5) + waves.at(x, y, frame));
  };

  Mesh primitives;
  add_surface(primitives, 0, squares + 1, squares + 1);
  const int in_cloth = (squares + 1) * (squares + 1);
  for (int i = 0; i < row * row; ++i) add_spike(primitives, in_cloth + i * (1 + spike_rings * spike_sides));
  return scene_of_formula(21, std::move(primitives), [=, field = SpikeField(row)](double frame) {
    // The rotation keeps the edges of the cloth from being parallel to the rows of spikes.
    const Rotation turned({0, 0, 1}, 0.02);
    PointList points = sheet_points(squares, [&](double x, double y) {
      const Vector3<double> p = turned({x, y, 0});
      return cloth(p[0] + 0.06 * frame, p[1] + 0.03 * frame, frame);
    });
    for (int j = 0; j < row; ++j)
      for (int i = 0; i < row; ++i) add_spike_points(points, field.place(i), field.place(j));
    return points;
  });
}

// --- sheets -----------------------------------------------------------------------------------------------

/// Five sheets, 0.5 apart, slide in different directions. Each sheet has waves of its own, up to 0.36 high.
Scene sheets(int size) {
  constexpr int count = 5;
  const int squares = nearest(std::sqrt(size / (2.0 * count)));
  const int in_sheet = (squares + 1) * (squares + 1);
  Mesh primitives;
  for (int i = 0; i < count; ++i) add_surface(primitives, i * in_sheet, squares + 1, squares + 1);
  return scene_of_formula(25, std::move(primitives), [=](double frame) {
    PointList points;
    points.reserve(static_cast<std::size_t>(count * in_sheet));
    for (int i = 0; i < count; ++i) {
      const Waves waves(sheets_waves, static_cast<std::uint64_t>(i), 0.12);
      const Rotation turned({0, 0, 1}, 0.03 * i);
      const CosSin slide = cos_sin(0.4 * i);
      const auto place = [&](double x, double y) {
        Vector3<double> p = turned({x, y, 0});
        p[0] += 0.15 * slide.cos * frame;
        p[1] += 0.15 * slide.sin * frame;
        p[2] = 0.5 * i + waves.at(p[0], p[1], frame);
        return p;
      };
      const PointList sheet = sheet_points(squares, place);
      points.insert(points.end(), sheet.begin(), sheet.end());
    }
    return points;
  });
}

// --- points -----------------------------------------------------------------------------------------------

/// Points fall, each at its own speed, through a waving surface. The surface has about as many triangles as
/// there are points.
Scene points(int size) {
  const int squares = nearest(std::sqrt(size / 2.0));
  Mesh primitives;
  add_surface(primitives, 0, squares + 1, squares + 1);
  return scene_of_formula(21, std::move(primitives), [=](double frame) {
    const Waves waves(points_waves, 0, 0.4);
    PointList all = sheet_points(
        squares, [&](double x, double y) { return Vector3<double>(x, y, waves.at(x, y, frame)); });
    for (int i = 0; i < size; ++i) {
      Random random(0, points_places, static_cast<std::uint64_t>(i));
      const double x = squares * (random.uniform() - 0.5);
      const double y = squares * (random.uniform() - 0.5);
      const double z = random.uniform(0, 8);
      all.emplace_back(x, y, z - random.uniform(0.3, 0.5) * frame);
    }
    return all;
  });
}

}  // namespace

std::vector<BuiltInScene> cloth_scenes() {
  constexpr int largest = 4'000'000;
  return {{"spikes", "a cloth falls on a square of spikes", 4000, 100, largest, spikes},
          {"sheets", "five wrinkled sheets slide over each other", 5000, 100, largest, sheets},
          {"points", "points fall through a surface that waves", 5000, 100, largest, points}};
}

}  // namespace nearmiss
