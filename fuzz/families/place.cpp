#include "fuzz/families/place.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "ccd/wang/cubic.hpp"
#include "ccd/wang/motion.hpp"
#include "ccd/wang/proximity.hpp"
#include "oracle/arithmetic/double_word.hpp"

namespace nearmiss {

namespace {

using certified::DoubleWord;

/// The vector between the two points of a Place is the sum of the eight positions, each multiplied by a
/// number, its share. Returns these shares.
std::array<DoubleWord, 8> shares(Kind kind, const Place& place) {
  const DoubleWord one = 1;
  const DoubleWord alpha = place.alpha;
  const DoubleWord beta = place.beta;
  const DoubleWord time = place.time;
  std::array<DoubleWord, 4> weights{one, alpha + beta - one, -alpha, -beta};
  if (!has_triangle(kind)) weights = {one - alpha, alpha, beta - one, -beta};
  std::array<DoubleWord, 8> shares;
  for (std::size_t i = 0; i < 4; ++i) {
    shares[i] = weights[i] * (one - time);
    shares[4 + i] = weights[i] * time;
  }
  return shares;
}

/// A number in [0, 1]: an end, a number next to an end, a number of few bits, or an arbitrary number.
double random_fraction(Random& random) {
  const double tiny = random.log_uniform(0x1p-53, 0x1p-4);
  switch (random.integer(0, 5)) {
    case 0:
      return 0;
    case 1:
      return 1;
    case 2:
      return tiny;
    case 3:
      return 1 - tiny;
    case 4:
      return random.integer(1, 15) / 16.0;
    default:
      return random.uniform();
  }
}

template <Kind kind>
Place place_of(Random& random, const Query& query) {
  Place place = random_place(random, kind);
  const auto pair = make_pair<kind, double>(query, normalising_frame<kind, double>(query));
  const auto roots = solve_cubic(coplanarity(pair), 0.0);
  const double time = roots.count > 0 ? roots.values[random.integer(0, roots.count - 1)] : place.time;
  const Configuration<kind, double> configuration(pair, time);
  const double first = configuration.weights[0] / configuration.NN;
  const double second = configuration.weights[1] / configuration.NN;
  if (!std::isfinite(first) || !std::isfinite(second)) return place;
  place.time = time;
  const double margin = random.one_in(2) ? 0 : random.log_uniform(0x1p-50, 0x1p-4);
  if constexpr (has_triangle(kind)) {
    place.beta = std::clamp(first, margin, 1 - 3 * margin);
    place.alpha = std::clamp(second, margin, 1 - place.beta - margin);
  } else {
    place.alpha = std::clamp(first, margin, 1 - margin);
    place.beta = std::clamp(second, margin, 1 - margin);
  }
  return place;
}

}  // namespace

Query joined(const Query& query, const Place& place, int point) {
  const auto share = shares(query.kind, place);
  const auto p = static_cast<std::size_t>(point);
  Query result = query;
  for (int pass = 0; pass < 2; ++pass)  // the second pass corrects the rounding errors of the first pass
    for (std::size_t k = 0; k < 3; ++k) {
      DoubleWord gap;
      for (std::size_t i = 0; i < 8; ++i) gap = gap + share[i] * DoubleWord(result.x[3 * i + k]);
      result.x[3 * p + k] -= gap.hi / share[p].hi;
    }
  return result;
}

std::vector<int> movable_points(Kind kind, const Place& place) {
  const auto share = shares(kind, place);
  std::vector<int> points;
  for (int i = 0; i < 8; ++i)
    if (std::abs(share[static_cast<std::size_t>(i)].hi) >= 1.0 / 64) points.push_back(i);
  return points;
}

Place random_place(Random& random, Kind kind) {
  Place place{};
  place.alpha = random_fraction(random);
  place.beta = random_fraction(random);
  if (has_triangle(kind)) place.beta *= 1 - place.alpha;
  place.time = random_fraction(random);
  return place;
}

Place own_place(Random& random, const Query& query) {
  return with_kind(query.kind, [&]<Kind kind>() { return place_of<kind>(random, query); });
}

}  // namespace nearmiss
