#include "fuzz/figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearmiss {

Vector3<double> Contact::velocity(Kind kind) const {
  Vector3<double> v = base.velocity() + beta * r.velocity();
  if (kind == Kind::vertex_triangle) v += alpha * q.velocity();
  return v;
}

Query meet(Kind kind, const Contact& contact, const Vector3<double>& w) {
  Vector3<double> point = contact.base.at(contact.time) + contact.beta * contact.r.at(contact.time);
  if (kind == Kind::vertex_triangle) point += contact.alpha * contact.q.at(contact.time);
  const Path touching{point - contact.time * w, point + (1 - contact.time) * w};

  Query query{.kind = kind};
  const auto set = [&](int vertex, const Vector3<double>& start, const Vector3<double>& end) {
    query.set_start(vertex, start);
    query.set_end(vertex, end);
  };
  const auto& [base, q, r, alpha, beta, time] = contact;
  if (kind == Kind::vertex_triangle) {
    set(0, touching.start, touching.end);
    set(1, base.start, base.end);
    set(2, base.start + q.start, base.end + q.end);
    set(3, base.start + r.start, base.end + r.end);
  } else {
    set(0, touching.start - alpha * q.start, touching.end - alpha * q.end);
    set(1, touching.start + (1 - alpha) * q.start, touching.end + (1 - alpha) * q.end);
    set(2, base.start, base.end);
    set(3, base.start + r.start, base.end + r.end);
  }
  return query;
}

Query shuffled(Random& random, const Query& query) {
  std::array<int, 4> order{0, 1, 2, 3};
  if (query.kind == Kind::vertex_triangle) {
    for (int i = 3; i > 1; --i)
      std::swap(order[static_cast<std::size_t>(i)], order[static_cast<std::size_t>(random.integer(1, i))]);
  } else {
    if (random.one_in(2)) std::swap(order[0], order[1]);
    if (random.one_in(2)) std::swap(order[2], order[3]);
    if (random.one_in(2)) order = {order[2], order[3], order[0], order[1]};
  }
  Query result{.kind = query.kind};
  for (int i = 0; i < 4; ++i) {
    result.set_start(i, query.start(order[static_cast<std::size_t>(i)]));
    result.set_end(i, query.end(order[static_cast<std::size_t>(i)]));
  }
  return result;
}

Query nudged(Random& random, Query query, int count, int most) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (int i = 0; i < count; ++i) {
    double& c = query.x[static_cast<std::size_t>(random.integer(0, 23))];
    const double toward = random.one_in(2) ? infinity : -infinity;
    for (int ulps = random.integer(1, most); ulps > 0; --ulps) {
      const double next = std::nextafter(c, toward);
      if (std::isfinite(next)) c = next;
    }
  }
  return query;
}

}  // namespace nearmiss
