// Scenes of twisted or tied objects: a knot, hair, a mat.
#include <algorithm>
#include <cmath>

#include "fuzz/random.hpp"
#include "fuzz/scenes/built_in/formulas.hpp"
#include "fuzz/scenes/built_in/themes.hpp"

namespace nearmiss {

namespace {

/// The streams of random numbers from which these scenes are made.
enum : std::uint64_t { hair_places = 201, mat_waves };

// --- knot -------------------------------------------------------------------------------------------------

/// The centre line of an overhand knot, as a function of the arc length from its middle. The line is a
/// trefoil, cut open at the outer end of a lobe, with straight lines added to both cut ends. The smallest
/// distance between strands of the line is 1.415, and the smallest radius of curvature is 1.1.
class KnotLine {
 public:
  KnotLine() {
    constexpr int pieces = 4096;
    constexpr double cut = 0.095;  // fraction of a turn that is cut off at each end
    for (int i = 0; i <= pieces; ++i) {
      const double turns = 0.5 + cut + (1 - 2 * cut) * i / pieces;
      const CosSin once = cos_sin(turns);
      const CosSin twice = cos_sin(2 * turns);
      points_.emplace_back(once.sin + 2 * twice.sin, once.cos - 2 * twice.cos,
                           -1.35 * cos_sin(3 * turns).sin);
      lengths_.push_back(i == 0 ? 0 : lengths_.back() + length(points_.back() - points_[points_.size() - 2]));
    }
  }

  /// The length of the knot without the straight ends.
  [[nodiscard]] double knotted() const { return lengths_.back(); }

  [[nodiscard]] Vector3<double> at(double from_middle) const {
    const double along = from_middle + knotted() / 2;
    const auto behind = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, along);
    const auto i = static_cast<std::size_t>(behind - lengths_.begin());
    // The place of the result on the segment from points_[i - 1] to points_[i]. On the straight ends of the
    // knot, `part` is outside [0, 1].
    const double part = (along - lengths_[i - 1]) / (lengths_[i] - lengths_[i - 1]);
    return points_[i - 1] + part * (points_[i] - points_[i - 1]);
  }

 private:
  PointList points_;
  std::vector<double> lengths_;
};

/// The points of a tube around a line, in rings. The first points of the rings do not turn about the line
/// (parallel transport), so the tube is not twisted.
PointList tube(const PointList& line, double radius, int sides) {
  PointList points;
  Vector3<double> normal(0.6, 0, 0.8);
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vector3<double> along = line[std::min(i + 1, line.size() - 1)] - line[i == 0 ? 0 : i - 1];
    const Vector3<double> tangent = along / length(along);
    normal -= dot(normal, tangent) * tangent;
    normal /= length(normal);
    for (int side = 0; side < sides; ++side)
      points.push_back(line[i] + radius * Rotation(tangent, static_cast<double>(side) / sides)(normal));
  }
  return points;
}

/// The ends of a knotted tube are pulled. The knot shrinks as the tube slides through the knot; the tube
/// keeps its length and radius. In the last frame, the tube's strands overlap by 0.3. A step moves the ends
/// by about half an edge.
Scene knot(int size) {
  constexpr int steps = 25;
  constexpr double radii_long = 52;  // length / radius of the tube
  constexpr double turn = 6.283185307179586;
  const double radius = std::sqrt(size / (2 * turn * radii_long));
  const int sides = std::max(3, nearest(turn * radius));
  const int rings = std::max(20, nearest(size / (2.0 * sides)));
  Mesh primitives;
  add_surface(primitives, 0, rings + 1, sides, true);
  return scene_of_formula(steps + 1, std::move(primitives), [=, knot_line = KnotLine()](double frame) {
    const double scale = (2 * radius - 0.3) / 1.415 + 0.05 * (steps - frame);
    const double edge = radii_long * radius / rings;
    PointList line;
    for (int i = 0; i <= rings; ++i) line.push_back(scale * knot_line.at((i - rings / 2.0) * edge / scale));
    return tube(line, radius, sides);
  });
}

// --- hair -------------------------------------------------------------------------------------------------

/// A bundle of curled hair, twisted by its ends and drawn together in the middle. n hairs have 4 sqrt(n)
/// lines each; neighbouring hairs are about as far apart as a line is long.
Scene hair(int size) {
  int hairs = 9;
  const auto lines_of = [](int count) { return nearest(4 * std::sqrt(static_cast<double>(count))); };
  while (static_cast<double>(hairs) * lines_of(hairs) < size) ++hairs;
  const int lines = lines_of(hairs);
  Mesh primitives;
  for (int i = 0; i < hairs; ++i) add_polyline(primitives, i * (lines + 1), lines + 1);
  return scene_of_formula(31, std::move(primitives), [=](double frame) {
    // The golden angle, in turns; it spreads points evenly over a disc.
    constexpr double golden = 0.3819660112501051;
    const double widest = 0.56 * std::sqrt(static_cast<double>(hairs));
    const double turns = 0.2 + 0.12 / widest * frame;
    const double drawn = 0.25 + std::min(0.012, 0.1 / widest) * frame;
    PointList points;
    for (int i = 0; i < hairs; ++i) {
      Random random(0, hair_places, static_cast<std::uint64_t>(i));
      const double curl_phase = random.uniform();
      const double curl_length = random.uniform(5, 9);
      const double curled = random.uniform(0.15, 0.35);
      const double away = 0.56 * std::sqrt(i + 0.5);
      const CosSin place = cos_sin(golden * i);
      for (int j = 0; j <= lines; ++j) {
        const double height = static_cast<double>(j) / lines - 0.5;
        const double narrow = 1 - drawn * (1 - 4 * height * height);
        const CosSin curl = cos_sin(curl_phase + j / curl_length);
        const Vector3<double> p(away * place.cos * narrow + curled * curl.cos,
                                away * place.sin * narrow + curled * curl.sin, height * lines);
        points.push_back(Rotation({0, 0, 1}, turns * height)(p));
      }
    }
    return points;
  });
}

// --- mat --------------------------------------------------------------------------------------------------

/// A cross-section of the rolled mat, with a point for each column. It consists of two spirals from the
/// middle, whose arms are pi / (2 tightness) apart. A point whose distance from the axis of the flat mat is s
/// has the distance s / sqrt(1 + tightness s) from the axis in the rolled mat. The total length of the
/// spirals is the width of the mat.
PointList rolled(int squares, double tightness) {
  constexpr int substeps = 16;
  constexpr double turns_of_a_radian = 0.15915494309189535;
  const auto radius = [&](double s) { return s / std::sqrt(1 + tightness * s); };
  PointList section(static_cast<std::size_t>(squares) + 1);
  // `half` counts half edges from the middle. The points are at even numbers of half edges if the number of
  // squares is even, and at odd numbers otherwise.
  double turns = 0;
  for (int half = 0; half <= squares; ++half) {
    if (half % 2 == squares % 2) {
      const CosSin angle = cos_sin(turns);
      const Vector3<double> p(radius(half / 2.0) * angle.cos, radius(half / 2.0) * angle.sin, 0);
      section[static_cast<std::size_t>((squares + half) / 2)] = p;
      section[static_cast<std::size_t>((squares - half) / 2)] = -p;
    }
    for (int i = 0; i < substeps; ++i) {
      const double begin = (half + i / double{substeps}) / 2;
      const double end = (half + (i + 1) / double{substeps}) / 2;
      const double out = radius(end) - radius(begin);
      const double around = std::sqrt(std::max((end - begin) * (end - begin) - out * out, 0.0));
      turns += around / radius((begin + end) / 2) * turns_of_a_radian;
    }
  }
  return section;
}

/// A mat, three times as long as wide, is twisted about its long axis by its ends while it rolls up and waves
/// slightly. A step moves the outermost points by about an edge, so a mat that is many edges wide must be
/// nearly rolled up from the first frame on.
Scene mat(int size) {
  constexpr int steps = 39;
  constexpr double tightest = 4;
  const int squares = nearest(std::sqrt(size / 6.0));
  const int length = nearest(size / (2.0 * squares));
  // The distance of the outermost points from the axis after the mat is rolled up.
  const double outermost = std::sqrt(squares / 2.0 / tightest);
  Mesh primitives;
  add_surface(primitives, 0, length + 1, squares + 1);
  return scene_of_formula(steps + 1, std::move(primitives), [=](double frame) {
    double tightness = tightest;
    for (int i = steps; i > static_cast<int>(frame); --i) tightness *= 1 - std::min(0.06, 1.4 / squares);
    const PointList section = rolled(squares, tightness);
    const double turns = (0.1 * length - 0.07 * (steps - frame)) / outermost;
    const double slope =
        3.14 * turns / length * outermost;  // half-way between the axis and the outermost points
    const double shortened = 1 / std::sqrt(1 + slope * slope);
    const Waves waves(mat_waves, 0, 0.13 / outermost);
    PointList points;
    points.reserve(section.size() * static_cast<std::size_t>(length + 1));
    for (int row = 0; row <= length; ++row) {
      const Rotation twist({0, 0, 1}, turns * (static_cast<double>(row) / length - 0.5));
      for (int column = 0; column <= squares; ++column) {
        const double wave = waves.at(column, row, frame);
        const Vector3<double> p = (1 + wave) * section[static_cast<std::size_t>(column)];
        points.push_back(twist(p) + Vector3<double>(0, 0, (row - length / 2.0) * shortened));
      }
    }
    return points;
  });
}

}  // namespace

std::vector<BuiltInScene> twisted_scenes() {
  constexpr int largest = 4'000'000;
  return {{"knot", "a tube with an overhand knot, which is pulled tight", 5000, 300, largest, knot},
          {"mat", "a mat is twisted by its ends until it rolls up", 5000, 100, largest, mat},
          {"hair", "a bundle of hair is twisted: lines only", 4000, 100, largest, hair}};
}

}  // namespace nearmiss
