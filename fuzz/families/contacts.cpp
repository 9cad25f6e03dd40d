#include "fuzz/families/contacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace nearmiss {

using Vector = Vector3<double>;

Path passing(const Vector& place, const Vector& velocity, double time) {
  return {place - time * velocity, place + (1 - time) * velocity};
}

Path scaled(const Path& path, double factor) { return {factor * path.start, factor * path.end}; }

Vector Contact::place(Kind kind) const {
  Vector c = beta * r.at(time);
  if (has_triangle(kind)) c += alpha * q.at(time);
  return c;
}

Vector Contact::velocity(Kind kind) const {
  Vector v = base.velocity() + beta * r.velocity();
  if (has_triangle(kind)) v += alpha * q.velocity();
  return v;
}

Query meet(Kind kind, const Contact& contact, const Vector& w) {
  Vector point = contact.base.at(contact.time) + contact.beta * contact.r.at(contact.time);
  if (has_triangle(kind)) point += contact.alpha * contact.q.at(contact.time);
  const Path touching = passing(point, w, contact.time);

  Query query{.kind = kind};
  const auto set = [&](int vertex, const Vector& start, const Vector& end) {
    query.set_start(vertex, start);
    query.set_end(vertex, end);
  };
  const auto& [base, q, r, alpha, beta, time] = contact;
  if (has_triangle(kind)) {
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

Vector ContactSampler::vector() {
  return exact_ ? Vector(random_.integer_vector(16) / 16) : random_.vector(1);
}

Vector ContactSampler::direction() {
  if (random_.one_in(2)) return Vector::Unit(random_.integer(0, 2));
  return vector();
}

Vector ContactSampler::velocity() {
  const double speed = fraction(12);
  return speed * direction();
}

double ContactSampler::weight() {
  switch (random_.integer(0, 7)) {
    case 0:
      return 0;
    case 1:
      return 1;
    case 2: {
      const double beyond = std::ldexp(1.0, -random_.integer(1, 52));
      return random_.one_in(2) ? -beyond : 1 + beyond;
    }
    default:
      return exact_ ? random_.integer(0, 16) / 16.0 : random_.uniform();
  }
}

Aim ContactSampler::aim(Kind kind) {
  Aim aim{};
  aim.alpha = weight();
  aim.beta = weight();
  aim.time = weight();
  if (has_triangle(kind) && aim.alpha + aim.beta > 1) {  // beyond the edge x2x3 of the triangle
    aim.alpha = 1 - aim.alpha;
    aim.beta = 1 - aim.beta;
  }
  if (has_triangle(kind) && random_.one_in(8)) aim.beta = 1 - aim.alpha;  // on the edge x2x3
  return aim;
}

Contact ContactSampler::contact(Kind kind, double speed) {
  const Aim place = aim(kind);
  Contact contact{.base = still(Vector::Zero()),
                  .q = {},
                  .r = {},
                  .alpha = place.alpha,
                  .beta = place.beta,
                  .time = place.time};
  for (Path* const side : {&contact.q, &contact.r}) {
    const Vector at_contact = vector();
    *side = passing(at_contact, speed * vector(), contact.time);
  }
  return contact;
}

void move_to_origin(Kind kind, Contact& contact, const Vector& velocity) {
  contact.base = passing(-contact.place(kind), velocity, contact.time);
}

// In meet(), each product has a factor below 2^20 and two multiples of 1/16: a weight and a time. A sum of at
// most three products has at most 20 + 8 + 3 bits, far below 53.
Contact integer_contact(Random& random, Kind kind) {
  const auto path = [&](int bits, int velocity_bits) {
    const Vector start = random.integer_vector((1 << bits) - 1);
    return Path{start, start + random.integer_vector((1 << velocity_bits) - 1)};
  };
  const int size = random.integer(1, 16);
  const int speed = random.integer(0, 16);
  Contact contact;
  contact.base = path(random.integer(0, 18), speed);
  contact.q = path(size, random.integer(0, speed));
  const int r_speed = random.integer(0, speed);
  contact.r = path(random.one_in(4) ? random.integer(1, 16) : size, r_speed);

  const auto weight = [&](int most) { return random.integer(0, most) / 16.0; };
  contact.alpha = random.one_in(4) ? 0 : weight(16);
  const int left = has_triangle(kind) ? 16 - static_cast<int>(16 * contact.alpha) : 16;
  const int place = random.integer(0, 7);
  contact.beta = place == 0 ? 0 : place == 1 ? left / 16.0 : weight(left);

  const int moment = random.integer(0, 7);
  contact.time = moment == 0 ? 0 : moment == 1 ? 1 : weight(16);
  return contact;
}

Query moved(Query query, const Vector& by) {
  for (std::size_t i = 0; i < 24; ++i) query.x[i] += by[static_cast<int>(i % 3)];
  return query;
}

Query with_first_moved(Query query, const Vector& by) {
  for (int i = 0; i < split(query.kind); ++i) {
    query.set_start(i, query.start(i) + by);
    query.set_end(i, query.end(i) + by);
  }
  return query;
}

Query placed(Random& random, Query query) {
  if (random.one_in(4)) query = moved(query, random.integer_vector(1 << 20));
  return rescaled(random, query);
}

Query rescaled(Random& random, Query query) {
  const double scale = std::ldexp(1.0, random.integer(-40, 20));
  for (double& c : query.x) c *= scale;
  query.separation *= scale;
  return shuffled(random, query);
}

Query turned(Random& random, Query query) {
  // Each pair consists of a matrix with orthogonal rows of equal length, and the length of these rows.
  static const std::array<std::pair<Eigen::Matrix3d, double>, 5> rotations{
      {{Eigen::Matrix3d{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 1},
       {Eigen::Matrix3d{{1, 2, 2}, {2, 1, -2}, {2, -2, 1}}, 3},
       {Eigen::Matrix3d{{3, 4, 0}, {-4, 3, 0}, {0, 0, 5}}, 5},
       {Eigen::Matrix3d{{2, 3, 6}, {3, -6, 2}, {6, 2, -3}}, 7},
       {Eigen::Matrix3d{{1, 4, 8}, {4, 7, -4}, {8, -4, 1}}, 9}}};
  const auto& [rotation, length] = one_of(random, rotations);
  const int first_axis = random.integer(0, 2);
  Vector signs;
  for (double& each : signs) each = random.one_in(2) ? -1 : 1;
  for (std::size_t i = 0; i < 24; i += 3) {
    const Vector point{query.x[i], query.x[i + 1], query.x[i + 2]};
    const Vector to = signs.cwiseProduct(rotation * point);
    for (int k = 0; k < 3; ++k)
      query.x[i + static_cast<std::size_t>(k)] = to[(first_axis + k) % 3] + 0.0;  // no -0
  }
  query.separation *= length;
  return query;
}

Query shuffled(Random& random, const Query& query) {
  std::array<int, 4> order{0, 1, 2, 3};
  if (has_triangle(query.kind)) {
    for (int i = vertices(query.kind) - 1; i > 1; --i)
      std::swap(order[static_cast<std::size_t>(i)], order[static_cast<std::size_t>(random.integer(1, i))]);
  } else {
    if (random.one_in(2)) std::swap(order[0], order[1]);
    if (random.one_in(2)) std::swap(order[2], order[3]);
    if (random.one_in(2)) order = {order[2], order[3], order[0], order[1]};
  }
  Query result = query;
  for (int i = 0; i < 4; ++i) {
    result.set_start(i, query.start(order[static_cast<std::size_t>(i)]));
    result.set_end(i, query.end(order[static_cast<std::size_t>(i)]));
  }
  return result;
}

double moved_by_ulps(double c, int ulps) {
  const double toward = std::copysign(std::numeric_limits<double>::max(), ulps);
  for (; ulps != 0; ulps += ulps < 0 ? 1 : -1) c = std::nextafter(c, toward);
  return c;
}

Query nudged(Random& random, Query query, int count, int most) {
  for (int i = 0; i < count; ++i) {
    double& c = query.x[static_cast<std::size_t>(random.integer(0, 23))];
    const int sign = random.one_in(2) ? 1 : -1;
    c = moved_by_ulps(c, sign * random.integer(1, most));
  }
  return query;
}

Query finished(Random& random, const Query& query) {
  const Query mixed = shuffled(random, query);
  return random.one_in(4) ? nudged(random, mixed, random.integer(1, 4), 4) : mixed;
}

double extent(const Query& query) {
  double largest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    double lo = query.x[k];
    double hi = lo;
    for (std::size_t i = k; i < 24; i += 3) {
      lo = std::min(lo, query.x[i]);
      hi = std::max(hi, query.x[i]);
    }
    largest = std::max(largest, hi - lo);
  }
  return largest;
}

double power_of_ten(double x) {
  constexpr double log2_of_10 = 3.3219280948873623;
  return std::ldexp(1.0, static_cast<int>(std::lround(x * log2_of_10)));
}

}  // namespace nearmiss
