// A plug-in that computes the distance of two primitives at rest, as many solvers do. The option defect=N
// adds typical mistake number N; defect=0 adds none.
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

#include "ccd/nearmiss_functions.hpp"

namespace {

struct Settings {
  double defect = 0;
};

constexpr std::array<nearmiss::Option<Settings>, 1> settings{{{"defect", &Settings::defect, 0, 100}}};

struct V {
  double x, y, z;
};
V operator+(V a, V b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
V operator-(V a, V b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
V operator*(double s, V a) { return {s * a.x, s * a.y, s * a.z}; }
double dot(V a, V b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
V cross(V a, V b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
double norm(V a) { return std::sqrt(dot(a, a)); }
double clamped(double t) { return std::clamp(t, 0.0, 1.0); }

class Distances {
 public:
  explicit Distances(const Settings& given) : defect_(static_cast<int>(given.defect)) {}

  double vv(V a, V b) const {
    const V d = a - b;
    while (is(26)) std::this_thread::sleep_for(std::chrono::seconds(1));  // never answers
    static std::atomic<int> calls = 0;
    // With defect 27, each call gives another distance, even for the same primitives.
    if (is(27)) return norm(d) * (1 + calls++ % 7);
    if (is(1)) return std::abs(d.x) + std::abs(d.y) + std::abs(d.z);  // another norm
    if (is(2)) return dot(d, d);                                      // no square root
    if (is(3)) return 1.02 * norm(d);                                 // rounded up
    if (is(4)) return norm(d) + 1e-4;                                 // an absolute margin
    return norm(d);
  }

  double ve(V p, V a, V b) const {
    const V edge = b - a;
    const double squared = dot(edge, edge);
    const double shortest = is(5) ? 1e-6 : 0;  // treats short edges as points
    if (!(squared > shortest) && !is(6)) return vv(p, a);
    // With defect 6, this quotient is 0 / 0 for an edge of length 0.
    const double t = dot(p - a, edge) / squared;
    if (is(7)) return vv(p, t < 0.5 ? a : b);                      // considers only the ends
    if (is(8)) return vv(p, a + std::clamp(t, 0.0, 0.99) * edge);  // stops before the end
    if (is(9) && t > 1) return vv(p, a);                           // takes the wrong end
    return vv(p, a + clamped(t) * edge);
  }

  double vt(V p, V a, V b, V c) const {
    double best =
        // Defect 10 leaves out an edge of the triangle.
        std::min({ve(p, a, b), ve(p, b, c), is(10) ? HUGE_VAL : ve(p, c, a)});
    // Defect 11 leaves out all edges of the triangle.
    if (is(11)) best = std::min({vv(p, a), vv(p, b), vv(p, c)});
    const V normal = cross(b - a, c - a);
    const double squared = dot(normal, normal);
    const double smallest = is(12) ? 1e-12 : 0;  // treats small triangles as degenerate
    if (!(squared > smallest)) return best;
    const double u = dot(cross(p - a, c - a), normal) / squared;
    const double v = dot(cross(b - a, p - a), normal) / squared;
    const double height = dot(p - a, normal);
    // With defect 13, points inside the triangle are found only for a vertex on one side of the plane.
    if (is(13) && height < 0) return best;
    const double least = is(14) ? 0.01 : 0;
    const bool is_inside = u >= least && v >= least && u + v <= (is(15) ? 0.5 : 1);
    if (is_inside)
      best = std::min(best, is(16) ? std::abs(height) / squared : std::abs(height) / std::sqrt(squared));
    return best;
  }

  double ee(V p, V p1, V q, V q1) const {
    const V d1 = p1 - p, d2 = q1 - q, r = p - q;
    double best = std::min({ve(p, q, q1), ve(p1, q, q1), ve(q, p, p1), ve(q1, p, p1)});
    const double a = dot(d1, d1), e = dot(d2, d2), b = dot(d1, d2), c = dot(d1, r), f = dot(d2, r);
    const double area = a * e - b * b;
    const bool has_lengths = a > 0 && e > 0;
    const auto at = [&](double s, double t) { return vv(p + s * d1, q + t * d2); };
    // In defects 17 and 18, edges count as parallel if `area` is at most a threshold. The threshold is
    // absolute in defect 17, and relative in defect 18.
    const double parallel = is(17) ? 1e-12 : is(18) ? 1e-4 * a * e : 0;
    if (is(17) || is(18)) {
      if (!has_lengths) return best;
      const double s = area > parallel ? clamped((b * f - c * e) / area) : 0;
      return at(s, clamped((b * s + f) / e));  // does not correct s when t is clamped
    }
    if (is(19)) {  // clamps s and t independently
      if (!(area > 0)) return best;
      return at(clamped((b * f - c * e) / area), clamped((a * f - b * c) / area));
    }
    if (is(20)) {  // clamps s first, and does not correct it when t is clamped
      if (!(area > 0)) return best;
      const double s = clamped((b * f - c * e) / area);
      return at(s, clamped((b * s + f) / e));
    }
    if (is(21) || is(22)) {  // projects points alternately onto the two edges, and stops too soon
      if (!has_lengths) return best;
      double s = 0, t = 0;
      for (int i = 0; i < (is(21) ? 2 : 20); ++i) {
        t = clamped((b * s + f) / e);
        s = clamped((b * t - c) / a);
      }
      return at(s, t);
    }
    if (is(23))
      best = std::min({vv(p, q), vv(p1, q), vv(p, q1), vv(p1, q1)});  // ignores ends against insides
    if (!(area > 0)) return best;
    const double s = (is(24) ? -b * f - c * e : b * f - c * e) / area;  // a wrong sign
    const double t = (a * f - b * c) / area;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) best = std::min(best, at(s, t));
    if (is(25)) return static_cast<double>(static_cast<float>(norm(p) + best) - static_cast<float>(norm(p)));
    return best;
  }

 private:
  bool is(int defect) const { return defect_ == defect; }

  int defect_;
};

double vv(const Settings& s, V a, V b) { return Distances(s).vv(a, b); }
double ve(const Settings& s, V p, V a, V b) { return Distances(s).ve(p, a, b); }
double vt(const Settings& s, V p, V a, V b, V c) { return Distances(s).vt(p, a, b, c); }
double ee(const Settings& s, V a, V b, V c, V d) { return Distances(s).ee(a, b, c, d); }

}  // namespace

NEARMISS_SUBJECT(detector("distances")
                     .options<settings>()
                     .vertex_vertex_distance(vv)
                     .vertex_edge_distance(ve)
                     .vertex_triangle_distance(vt)
                     .edge_edge_distance(ee))
