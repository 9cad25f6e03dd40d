#include "tests/root_count.hpp"

#include <CGAL/Algebraic_kernel_d_1.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Gmpz.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <vector>

namespace nearmiss::testing {

namespace {

using Kernel = CGAL::Algebraic_kernel_d_1<CGAL::Gmpz>;
using Polynomial = Kernel::Polynomial_1;
using Root = Kernel::Algebraic_real_1;
using Vector = std::array<Polynomial, 3>;

Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Polynomial dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

int sign_at(const Polynomial& p, const Root& t) { return Kernel().sign_at_1_object()(p, t); }

/// The distinct roots in [0, 1] of a polynomial other than 0.
std::vector<Root> roots_in_step(const Polynomial& p) {
  std::vector<Root> roots;
  if (p.degree() > 0) Kernel().solve_1_object()(p, false, std::back_inserter(roots));
  std::erase_if(roots, [](const Root& t) { return t < Root(0) || t > Root(1); });
  return roots;
}

/// Two polynomials for a vertex and an edge: the vertex is on the edge iff off_line = 0 and beyond <= 0.
struct OnEdge {
  Polynomial off_line, beyond;
};

/// The polynomials in t whose signs decide whether the primitives meet. Coordinates are expressed as integer
/// multiples of a power of two.
struct Polynomials {
  Polynomial F;
  Polynomial area;                  ///< N · N
  std::vector<Polynomial> weights;  ///< barycentric weights times N · N
  std::vector<OnEdge> vertices_and_edges;

  explicit Polynomials(const Query& query) {
    int least = std::numeric_limits<int>::max();
    for (const double c : query.x)
      if (c != 0) least = std::min(least, std::ilogb(c) - 52);
    const auto integer = [&](double c) {
      if (c == 0) return CGAL::Gmpz(0);
      const int exponent = std::ilogb(c) - 52;
      return CGAL::Gmpz(std::ldexp(c, -exponent)) << static_cast<unsigned long>(exponent - least);
    };
    std::array<Vector, 4> x;
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 3; ++k) {
        const CGAL::Gmpz start = integer(query.start(i)[k]);
        x[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] =
            Polynomial(start, integer(query.end(i)[k]) - start);
      }
    const auto difference = [&](VertexPair pair) {
      return x[static_cast<std::size_t>(pair.to)] - x[static_cast<std::size_t>(pair.from)];
    };
    const Topology& of = topology(query.kind);
    const Vector p = difference(of.pqr[0]);
    const Vector q = difference(of.pqr[1]);
    const Vector r = difference(of.pqr[2]);
    const Vector N = cross(q, r);
    F = dot(p, N);
    area = dot(N, N);
    const Polynomial of_q = dot(cross(p, r), N);
    if (has_triangle(query.kind)) {  // p = w2 q + w3 r
      const Polynomial of_r = dot(cross(q, p), N);
      weights = {area - of_q - of_r, of_q, of_r};
    } else {  // p = α q - β r
      const Polynomial of_r = dot(cross(p, q), N);
      weights = {of_q, area - of_q, of_r, area - of_r};
    }
    for (const auto& [vertex, from, to] : of.vertices_and_edges) {
      const Vector from_start = difference({vertex, from});
      const Vector off = cross(from_start, difference({from, to}));
      vertices_and_edges.push_back({dot(off, off), dot(from_start, difference({vertex, to}))});
    }
  }
};

/// Whether and where the primitives meet at a time when all vertices are in one plane. `at_border` means that
/// they meet at a border of the triangle or at an end of an edge. If the normal N is 0 at this time,
/// `at_border` means that the primitives meet somewhere.
enum class Meeting { none, inside, at_border };

Meeting meeting_at(const Polynomials& of, const Root& t) {
  if (sign_at(of.area, t) > 0) {
    int least = 1;
    for (const Polynomial& weight : of.weights) least = std::min(least, sign_at(weight, t));
    return least > 0 ? Meeting::inside : least == 0 ? Meeting::at_border : Meeting::none;
  }
  const bool any = std::any_of(
      of.vertices_and_edges.begin(), of.vertices_and_edges.end(),
      [&](const OnEdge& on) { return sign_at(on.off_line, t) == 0 && sign_at(on.beyond, t) <= 0; });
  return any ? Meeting::at_border : Meeting::none;
}

int multiplicity(Polynomial p, const Root& t) {
  int m = 0;
  for (; p.degree() >= 0 && !p.is_zero() && sign_at(p, t) == 0; p.diff()) ++m;
  return m;
}

/// Whether the primitives meet in [0, 1] if F, the coplanarity cubic, is identically zero. The times of
/// contact are a closed set, and the first time of contact is 0 or a root of a polynomial in `deciding`.
bool meet_in_a_plane(const Polynomials& of) {
  std::vector<Polynomial> deciding{of.area};
  deciding.insert(deciding.end(), of.weights.begin(), of.weights.end());
  for (const OnEdge& on : of.vertices_and_edges) {
    deciding.push_back(on.off_line);
    deciding.push_back(on.beyond);
  }
  std::vector<Root> times{Root(0)};
  for (const Polynomial& p : deciding)
    if (!p.is_zero())
      for (const Root& t : roots_in_step(p)) times.push_back(t);
  return std::any_of(times.begin(), times.end(),
                     [&](const Root& t) { return meeting_at(of, t) != Meeting::none; });
}

}  // namespace

RootCount count_roots(const Query& query) {
  const Polynomials of(query);
  RootCount count;
  count.planar = of.F.is_zero();
  if (count.planar) {
    count.collision = meet_in_a_plane(of);
    count.on_boundary = count.collision;
    return count;
  }
  for (const Root& t : roots_in_step(of.F)) {
    const Meeting meeting = meeting_at(of, t);
    if (meeting == Meeting::none) continue;
    count.collision = true;
    count.on_boundary |= meeting == Meeting::at_border || t == Root(0) || t == Root(1);
    ++count.distinct;
    count.with_multiplicity += multiplicity(of.F, t);
  }
  return count;
}

int roots_before(const Query& query, double time) {
  const auto roots = roots_in_step(Polynomials(query).F);
  const Root end{CGAL::Gmpq(time)};
  return static_cast<int>(std::count_if(roots.begin(), roots.end(), [&](const Root& t) { return t < end; }));
}

}  // namespace nearmiss::testing
