#include "fuzz/studies/audit/samples.hpp"

namespace nearmiss::audit_parts {

namespace {

double component(Random& random, double size) {
  switch (random.integer(0, 3)) {
    case 0: {
      const double positive = size * (1 - random.log_uniform(1e-17, 1));
      return positive * (random.one_in(2) ? 1 : -1);
    }
    case 1: {
      const double x = random.uniform(-size, size);
      return x * random.log_uniform(1e-9, 1);
    }
    default:
      return random.uniform(-size, size);
  }
}

/// Draws a component of a position and of a velocity such that both ends are within the size.
void draw_component(Random& random, Moving<double>& vector, int i, double size) {
  do {
    vector.xv[i] = component(random, size);
    vector.xv[i + 3] = random.one_in(6) ? 0 : component(random, 1);
  } while (std::abs(vector.xv[i]) > size || std::abs(vector.xv[i] + vector.xv[i + 3]) > size);
}

double draw_time(Random& random) {
  return random.one_in(4) ? 1 - random.log_uniform(1e-17, 1) : random.uniform();
}

}  // namespace

bool AuditSample::within_bounds() const {
  const auto within = [this](const Moving<double>& m, double size) {
    const double most = size * B * (1 - 8 * epsilon<double>());
    return max_component(m.x()) <= most && max_component(m.v()) <= B * (1 - 8 * epsilon<double>()) &&
           max_component(Vector3<double>(m.x() + m.v())) <= most;
  };
  return B > 0 && within(p, reach) && within(q, 1) && within(r, 1);
}

AuditSample draw_sample(Random& random, double reach) {
  AuditSample sample;
  sample.reach = reach;
  for (int i = 0; i < 3; ++i) {
    draw_component(random, sample.p, i, reach);
    draw_component(random, sample.q, i, 1);
    draw_component(random, sample.r, i, 1);
  }
  sample.t = draw_time(random);
  sample.eta = 1 - random.log_uniform(1e-9, 1);
  sample.S = 1 - random.log_uniform(1e-9, 1);
  return sample;
}

AuditSample changed(Random& random, const AuditSample& sample) {
  AuditSample next = sample;
  for (int count = random.integer(1, 3); count > 0; --count) {
    const int which = random.integer(0, 10);
    if (which == 9) {
      next.t = random.one_in(2) ? draw_time(random) : std::abs(sample.t - random.log_uniform(1e-17, 0.1));
      continue;
    }
    if (which == 10) {
      (random.one_in(2) ? next.eta : next.S) = 1 - random.log_uniform(1e-9, 1);
      continue;
    }
    Moving<double>& vector = which < 3 ? next.p : which < 6 ? next.q : next.r;
    const int i = which % 3;
    const double size = which < 3 ? sample.reach : 1;
    if (random.one_in(2)) {
      draw_component(random, vector, i, size);
    } else {  // change the bits that decide about rounding
      const double direction = random.uniform(-1, 1);
      const double change = direction * random.log_uniform(1e-16, 1e-1);
      vector.xv[i + 3 * random.integer(0, 1)] *= 1 + change;
    }
  }
  return next.t <= 1 && next.within_bounds() ? next : sample;
}

std::optional<AuditSample> sample_of(const Query& query, Random& random) {
  AuditSample sample;
  const auto fill = [&](const auto& pair) {
    sample.p = pair.p;
    sample.q = pair.q;
    sample.r = pair.r;
    sample.B = pair.B;
  };
  if (query.kind == Kind::vertex_triangle)
    fill(make_pair<Kind::vertex_triangle, double>(query));
  else
    fill(make_pair<Kind::edge_edge, double>(query));
  sample.t = draw_time(random);
  sample.eta = sample.B * random.uniform();
  sample.S = sample.B * random.uniform();
  sample.query = query;
  if (!in_range(sample.B) || !sample.within_bounds()) return std::nullopt;
  return sample;
}

Moving<AuditedRational> exactly(const Moving<double>& vector, double reach) {
  Moving<AuditedRational> leaves;
  for (int i = 0; i < 6; ++i) leaves.xv[i] = {vector.xv[i], vector.xv[i], {i < 3 ? reach : 1, 1, 0}};
  return leaves;
}

Moving<AuditedRational> rounded(const Query& query, int a, int b) {
  const Moving<double> vector = relative_motion<double>(query, a, b);
  Moving<AuditedRational> leaves;
  const auto difference = [&](int time, int i) {
    const auto at = [&](int vertex) {
      return Rational(query.x[static_cast<std::size_t>(12 * time + 3 * vertex + i)]);
    };
    return Rational(at(a) - at(b));
  };
  for (int i = 0; i < 3; ++i) {
    leaves.xv[i] = {vector.xv[i], difference(0, i), {1, 1, 1}};
    leaves.xv[i + 3] = {vector.xv[i + 3], difference(1, i) - difference(0, i), {1, 1, 3}};
  }
  return leaves;
}

}  // namespace nearmiss::audit_parts
