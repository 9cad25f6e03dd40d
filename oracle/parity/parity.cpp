#include "oracle/parity/parity.hpp"

#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "ccd/query/arithmetic.hpp"

namespace nearmiss {

namespace parity {
namespace {

/// Integers of any size, stored in place up to 512 bits: most determinants of a query's coordinates fit.
using IntegerBackend =
    boost::multiprecision::cpp_int_backend<512, 0, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::unchecked,
                                           std::allocator<boost::multiprecision::limb_type>>;
using Integer = boost::multiprecision::number<IntegerBackend, boost::multiprecision::et_off>;
using IntegerVector = CGAL::Simple_cartesian<Integer>::Vector_3;

int sign(const Integer& x) { return x.sign(); }
Integer determinant(const IntegerVector& a, const IntegerVector& b, const IntegerVector& c) {
  return CGAL::cross_product(a, b) * c;
}

// --- directions -------------------------------------------------------------------------------------------

/// The direction of a ray: a vector. If the vector is not set, the direction is (1, ε, ε²) for an
/// infinitesimal ε > 0.
using RayDirection = std::optional<IntegerVector>;

/// The sign of the dot product n · d. If d is (1, ε, ε²), this is the sign of the first component of n that
/// is not zero.
int side(const IntegerVector& n, const RayDirection& d) {
  if (d) return sign(n * *d);
  for (int k = 0; k < 3; ++k)
    if (const int s = sign(n[k]); s != 0) return s;
  return 0;
}

const std::vector<RayDirection>& directions() {
  static const std::vector<RayDirection> list{IntegerVector(3, 5, 7), IntegerVector(-11, 2, 13),
                                              IntegerVector(17, -19, 4), IntegerVector(1, 23, -9),
                                              std::nullopt};
  return list;
}

// --- triangles --------------------------------------------------------------------------------------------

/// The number of times that a ray from the origin crosses a surface. The value is nothing if this number is
/// undefined, because the ray meets an edge of the surface or runs in its plane.
using Crossings = std::optional<int>;

/// The number of times that a ray with direction d crosses a triangle that does not contain the origin.
Crossings cross_triangle(const IntegerVector& a, const IntegerVector& b, const IntegerVector& c,
                         const RayDirection& d) {
  const int volume = sign(determinant(a, b, c));
  if (volume == 0) {
    // The triangle's plane contains the origin, so a ray that leaves the plane does not meet the triangle.
    const IntegerVector n = CGAL::cross_product(b - a, c - a);
    if (n == CGAL::NULL_VECTOR) {
      // The triangle is a segment or a point. Only a ray in a plane through the origin and the triangle can
      // meet the triangle.
      for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
        if (const IntegerVector m = CGAL::cross_product(p, q); m != CGAL::NULL_VECTOR && side(m, d) == 0)
          return std::nullopt;
      const bool along = d && CGAL::cross_product(a, *d) == CGAL::NULL_VECTOR;
      return along ? Crossings() : Crossings(0);
    }
    return side(n, d) == 0 ? Crossings() : Crossings(0);
  }
  const std::array sides{side(CGAL::cross_product(a, b), d), side(CGAL::cross_product(b, c), d),
                         side(CGAL::cross_product(c, a), d)};
  const auto [least, most] = std::minmax_element(sides.begin(), sides.end());
  if (*least < 0 && *most > 0) return 0;
  if (std::count(sides.begin(), sides.end(), 0) > 0) return std::nullopt;
  return *least == volume ? 1 : 0;  // 1 if the ray meets the triangle, 0 if the opposite ray does
}

// --- bilinear patches -------------------------------------------------------------------------------------

/// The image of a square under the map p00 (1-s)(1-t) + p10 s (1-t) + p01 (1-s) t + p11 s t. The image may be
/// flat.
struct BilinearPatch {
  IntegerVector p00, p10, p01, p11;
};

/// p + q √D.
struct Surd {
  Integer p, q, D;

  [[nodiscard]] int sign_of() const {
    const int sp = sign(p);
    const int sq = sign(q) * sign(D);
    if (sp == 0 || sq == 0 || sp == sq) return sp != 0 ? sp : sq;
    const int larger = sign(p * p - q * q * D);
    return larger > 0 ? sp : larger < 0 ? sq : 0;
  }
};

/// c0 + c1 t + c2 t².
using Quadratic = std::array<Integer, 3>;

bool is_zero(const Quadratic& f) { return f[0] == 0 && f[1] == 0 && f[2] == 0; }

/// Whether the quadratic h is at most 0 at some t in [0, 1].
bool reaches_zero(const Quadratic& h) {
  if (sign(h[0]) <= 0 || sign(h[0] + h[1] + h[2]) <= 0) return true;
  return sign(h[2]) > 0 && sign(h[1]) < 0 && sign(h[1] + 2 * h[2]) > 0 &&
         sign(h[1] * h[1] - 4 * h[0] * h[2]) >= 0;
}

/// Whether the quadratic h is at most 0 at a root of g in [0, 1]; g must not be identically zero.
bool reaches_zero_at_root(Quadratic g, const Quadratic& h) {
  if (sign(g[2]) < 0 || (g[2] == 0 && sign(g[1]) < 0))
    for (Integer& c : g) c = -c;
  if (g[2] == 0) {  // the only root is numerator / g1
    const Integer numerator = -g[0];
    return g[1] != 0 && numerator >= 0 && numerator <= g[1] &&
           h[0] * g[1] * g[1] + numerator * (h[1] * g[1] + h[2] * numerator) <= 0;
  }
  const Integer D = g[1] * g[1] - 4 * g[0] * g[2];
  if (sign(D) < 0) return false;
  const Integer twice = 2 * g[2];  // the roots are (-g1 ± √D) / twice
  const Integer A = g[2] * h[0] - h[2] * g[0];
  const Integer B = g[2] * h[1] - h[2] * g[1];  // g2 h - h2 g = A + B t, which is g2 h at the roots of g
  for (const int branch : {1, -1}) {
    const bool in_step =
        Surd{-g[1], branch, D}.sign_of() >= 0 && Surd{-g[1] - twice, branch, D}.sign_of() <= 0;
    if (in_step && Surd{A * twice - B * g[1], B * branch, D}.sign_of() <= 0) return true;
  }
  return false;
}

/// Whether the origin is on a flat patch. The origin must be in the plane of the patch. The origin is on the
/// patch iff, for some t in [0, 1], it is on the segment from the patch's point for (0, t) to its point for
/// (1, t).
bool flat_patch_holds_origin(const BilinearPatch& patch) {
  const IntegerVector a0 = patch.p00;
  const IntegerVector a1 = patch.p01 - patch.p00;
  const IntegerVector b0 = patch.p10;
  const IntegerVector b1 = patch.p11 - patch.p10;
  const IntegerVector c0 = CGAL::cross_product(a0, b0);
  const IntegerVector c1 = CGAL::cross_product(a0, b1) + CGAL::cross_product(a1, b0);
  const IntegerVector c2 = CGAL::cross_product(a1, b1);
  const Quadratic between{a0 * b0, a0 * b1 + a1 * b0, a1 * b1};
  for (int k = 0; k < 3; ++k) {
    const Quadratic g{c0[k], c1[k], c2[k]};
    if (!is_zero(g)) return reaches_zero_at_root(g, between);
  }
  return reaches_zero(between);
}

/// The place of the origin relative to a patch. The barycentric coordinates λ of a point in the tetrahedron
/// of the corners satisfy λ00 λ11 = λ10 λ01 only on the patch. The two faces of the tetrahedron that share
/// the edge p00 p11 are on the side of the patch on which λ00 λ11 > λ10 λ01.
struct Position {
  bool on_patch = false;
  bool in_plane = false;    ///< the origin is in the plane of a flat patch, but not on the patch
  bool other_pair = false;  ///< the triangles that replace the patch share the edge p10 p01, not p00 p11
};

Position position(const BilinearPatch& patch) {
  const auto& [p00, p10, p01, p11] = patch;
  Position result;
  const Integer volume = determinant(p10 - p00, p01 - p00, p11 - p00);
  if (volume == 0) {
    const bool in_plane = determinant(p00, p10, p01) == 0 && determinant(p00, p10, p11) == 0 &&
                          determinant(p00, p01, p11) == 0 && determinant(p10, p01, p11) == 0;
    result.on_patch = in_plane && flat_patch_holds_origin(patch);
    result.in_plane = in_plane && !result.on_patch;
    return result;
  }
  // Each λ times the volume of the tetrahedron is a determinant in which the origin replaces one corner.
  const Integer l00 = determinant(p10, p01, p11);
  const Integer l10 = -determinant(p00, p01, p11);
  const Integer l01 = determinant(p00, p10, p11);
  const Integer l11 = -determinant(p00, p10, p01);
  const int v = sign(volume);
  const bool inside = sign(l00) * v >= 0 && sign(l10) * v >= 0 && sign(l01) * v >= 0 && sign(l11) * v >= 0;
  if (!inside) return result;
  const int between = sign(l00 * l11 - l10 * l01);
  result.on_patch = between == 0;
  result.other_pair = between > 0;
  return result;
}

/// The number of times that a ray with direction d crosses a patch that does not contain the origin. Instead
/// of the patch, the function takes two triangles, which together have the border of the patch, and counts
/// how often the ray crosses them. The origin is not between these triangles and the patch.
Crossings cross_patch(const BilinearPatch& patch, const Position& position, const RayDirection& d) {
  const auto& [p00, p10, p01, p11] = patch;
  if (position.in_plane) {
    for (const auto& [p, q] : {std::pair(p00, p10), std::pair(p00, p01), std::pair(p00, p11),
                               std::pair(p10, p01), std::pair(p10, p11), std::pair(p01, p11)})
      if (const IntegerVector n = CGAL::cross_product(p, q); n != CGAL::NULL_VECTOR)
        return side(n, d) == 0 ? Crossings() : Crossings(0);
    const bool along = d && CGAL::cross_product(p00, *d) == CGAL::NULL_VECTOR;
    return along ? Crossings() : Crossings(0);
  }
  const auto first =
      position.other_pair ? cross_triangle(p00, p10, p01, d) : cross_triangle(p00, p10, p11, d);
  const auto second =
      position.other_pair ? cross_triangle(p10, p11, p01, d) : cross_triangle(p00, p11, p01, d);
  if (!first || !second) return std::nullopt;
  return *first + *second;
}

// --- the boundary of the domain ---------------------------------------------------------------------------

/// For each axis, the smallest k such that 2^k times a coordinate is an integer for every coordinate along
/// this axis. Scaling an axis changes no answer.
using Scale = std::array<int, 3>;

Scale integer_scale(const Query& query) {
  Scale scale;
  scale.fill(std::numeric_limits<int>::min());
  for (std::size_t i = 0; i < query.x.size(); ++i) {
    constexpr int digits = 53;
    int exponent = 0;
    const double whole = std::ldexp(std::frexp(query.x[i], &exponent), digits);
    if (whole == 0) continue;
    const int zeros = std::countr_zero(static_cast<std::uint64_t>(std::abs(whole)));
    scale[i % 3] = std::max(scale[i % 3], digits - exponent - zeros);
  }
  return scale;
}

Integer scaled(double coordinate, int exponent) {
  if (coordinate == 0) return 0;
  const int own = std::ilogb(coordinate) - 52;
  Integer integer(static_cast<long>(std::ldexp(coordinate, -own)));
  if (own + exponent >= 0)
    integer <<= static_cast<unsigned long>(own + exponent);
  else
    integer >>= static_cast<unsigned long>(-own - exponent);  // drops only zero bits
  return integer;
}

IntegerVector difference(const Query& query, int i, int j, std::size_t time, const Scale& scale) {
  const auto p = time == 0 ? query.start(i) : query.end(i);
  const auto q = time == 0 ? query.start(j) : query.end(j);
  const auto along = [&](int k) {
    const int exponent = scale[static_cast<std::size_t>(k)];
    return scaled(p[k], exponent) - scaled(q[k], exponent);
  };
  return {along(0), along(1), along(2)};
}

/// The images under f (parity.hpp) of the faces of its domain, a prism or a cube. A triangle is stored as a
/// patch with a side of length 0.
std::vector<BilinearPatch> boundary(const Query& query) {
  const Scale scale = integer_scale(query);
  std::array<std::array<std::array<IntegerVector, 2>, 4>, 4>
      differences;  // between a vertex of one primitive and a vertex of the other
  const Topology& of = topology(query.kind);
  for (const auto& [i, j] : of.gaps)
    for (const std::size_t time : {0U, 1U}) differences[i][j][time] = difference(query, i, j, time, scale);
  const auto f = [&](std::size_t i, std::size_t j, std::size_t time) { return differences[i][j][time]; };
  std::vector<BilinearPatch> faces;
  for (const std::size_t time : {0U, 1U}) {
    if (has_triangle(query.kind))
      faces.push_back({f(0, 1, time), f(0, 2, time), f(0, 1, time), f(0, 3, time)});
    else
      faces.push_back({f(0, 2, time), f(1, 2, time), f(0, 3, time), f(1, 3, time)});
  }
  // Each of the other faces belongs to a vertex of one primitive and an edge of the other primitive.
  for (const auto& [vertex, from, to] : of.first_to_second)
    faces.push_back({f(vertex, from, 0), f(vertex, to, 0), f(vertex, from, 1), f(vertex, to, 1)});
  for (const auto& [vertex, from, to] : of.second_to_first)
    faces.push_back({f(from, vertex, 0), f(to, vertex, 0), f(from, vertex, 1), f(to, vertex, 1)});
  return faces;
}

}  // namespace
}  // namespace parity

RootParity root_parity(const Query& query) {
  using namespace parity;
  const PlainArithmetic guard;
  const std::vector<BilinearPatch> faces = boundary(query);
  std::vector<Position> positions;
  for (const BilinearPatch& face : faces) {
    positions.push_back(position(face));
    if (positions.back().on_patch) return {.on_boundary = true};
  }
  for (const RayDirection& d : directions()) {
    int sum = 0;
    bool told = true;
    for (std::size_t i = 0; i < faces.size() && told; ++i) {
      const Crossings crossings = cross_patch(faces[i], positions[i], d);
      told = crossings.has_value();
      sum += crossings.value_or(0);
    }
    if (told) return {.odd = sum % 2 == 1};
  }
  return {};  // unreachable: the direction (1, ε, ε²) meets no edge
}

}  // namespace nearmiss
