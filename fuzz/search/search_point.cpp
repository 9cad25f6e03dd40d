#include "fuzz/search/search_point.hpp"

#include <algorithm>
#include <cmath>

#include "ccd/wang/elementary.hpp"

namespace nearmiss {

using Vector = Vector3<double>;

double search_log_uniform(Random& random, double lo, double hi) {
  return exp2_of(random.uniform(log2_of(lo), log2_of(hi)));
}

SearchPoint draw_search_point(Random& random, double smallest) {
  const auto some = [&](double lo, double hi) {
    return random.one_in(3) ? search_log_uniform(random, lo, hi) : hi;
  };
  const auto path = [&](const Vector& start, double speed) {
    return Path{start, start + random.vector(speed)};
  };
  // Each number is drawn in its own statement, since the compiler chooses the order in which it evaluates
  // arguments.
  const auto some_path = [&] {
    const Vector start = random.vector(some(smallest, 1));
    return path(start, random.one_in(3) ? 0 : some(smallest, 1));
  };
  SearchPoint m;
  m.q = some_path();
  m.r = some_path();
  if (random.one_in(3)) {
    const double along = random.uniform(-1.5, 1.5);
    const double across = some(0.1 * smallest, 1e-1);
    m.r = {along * m.q.start + random.vector(across), along * m.q.end + random.vector(across)};
  }
  for (double& c : m.place) c = random.one_in(3) ? random.integer(0, 1) : random.uniform();
  m.w = random.vector(some(smallest, 1));
  if (random.one_in(3)) {
    const Vector along_q = random.uniform(-1, 1) * m.q.at(m.place[2]);
    const Vector along_r = random.uniform(-1, 1) * m.r.at(m.place[2]);
    m.w = along_q + along_r + random.vector(some(0.1 * smallest, 1e-1));
  }
  if (random.one_in(4)) {
    const double out_of_plane = search_log_uniform(random, 1e-4 * smallest * smallest, 1e-2);
    for (Vector* v : {&m.q.start, &m.q.end, &m.r.start, &m.r.end, &m.w}) (*v)[2] *= out_of_plane;
  }
  m.gap.setZero();
  return m;
}

/// Vectors have components within 2^3 that are multiples of 2^-22; weights and times are multiples of 2^-10.
/// A sum of products in `meet` has at most 3 bits before the point, 3 more for carries, and 22 + 2 · 10 bits
/// after the point: 48 in all.
SearchPoint on_grid(SearchPoint point) {
  const auto round_to = [](double x, double unit) { return std::nearbyint(x / unit) * unit; };
  point.visit(true, [&](Vector& v) {
    for (double& c : v) c = round_to(std::clamp(c, -8.0, 8.0), 0x1p-22);
  });
  for (double& c : point.place) c = round_to(c, 0x1p-10);
  return point;
}

Vector draw_gap(Random& random, double h) { return h * random.vector(1); }  // vector(h) could overflow

SearchPoint with_gap_within(SearchPoint point, double h) {
  if (h == 0) {
    point.gap.setZero();
    return point;
  }
  // The length of the gap as a multiple of h; with h as the unit, nothing overflows.
  const double length = (point.gap / h).norm();
  if (length > 1) point.gap /= length;
  return point;
}

Contact contact_of(Kind kind, const SearchPoint& point) {
  const auto clamped = [](double x) { return std::clamp(x, 0.0, 1.0); };
  Contact contact{still(Vector::Zero()),  point.q, point.r, clamped(point.place[0]), clamped(point.place[1]),
                  clamped(point.place[2])};
  if (has_triangle(kind)) contact.beta = std::min(contact.beta, 1 - contact.alpha);
  if (vertices(kind) < 4) contact.beta = 0;
  if (vertices(kind) < 3) contact.alpha = 0;
  return contact;
}

Query query_of(Kind kind, const SearchPoint& point, double h) {
  Query query = with_first_moved(meet(kind, contact_of(kind, point), point.w), point.gap);
  for (std::size_t i = 0; i < query.x.size(); ++i) query.x[i] += point.moved[i];
  query.separation = h;
  repeat_vertices(query);
  return query;
}

std::array<double, 6> hardness(Kind kind, const SearchPoint& point) {
  const Contact contact = contact_of(kind, point);
  const Vector q = contact.q.at(contact.time);
  const Vector r = contact.r.at(contact.time);
  const Vector n = q.cross(r);
  const Vector relative = point.w - contact.velocity(kind);
  const auto ratio = [](double a, double b) { return b > 0 ? log2_of(std::max(a / b, 0x1p-40)) : -40; };
  const double third = has_triangle(kind) ? 1 - contact.alpha - contact.beta : 1;
  return {ratio(std::abs(n.dot(relative)), n.norm() * relative.norm()),
          ratio(n.norm(), q.norm() * r.norm()),
          ratio(std::min({contact.alpha, contact.beta, 1 - contact.alpha, 1 - contact.beta, third}), 1),
          ratio(std::min(q.norm(), r.norm()), std::max(q.norm(), r.norm())),
          ratio(std::min(contact.time, 1 - contact.time), 1),
          ratio(std::max(q.norm(), r.norm()), relative.norm())};
}

}  // namespace nearmiss
