#include "fuzz/trial/committed.hpp"

#include <cmath>
#include <cstddef>

#include "oracle/oracle.hpp"

namespace nearmiss {

namespace {

/// Replaces the query's positions at t = 1 by its positions at a time, computed in `Scalar`. Returns whether
/// all coordinates are finite.
template <class Scalar>
bool move_end(Query& query, double time) {
  const auto t = static_cast<Scalar>(time);
  constexpr std::size_t half = 12;
  bool is_finite = true;
  for (std::size_t i = 0; i < half; ++i) {
    const auto start = static_cast<Scalar>(query.x[i]);
    const auto end = static_cast<Scalar>(query.x[half + i]);
    const Scalar motion = end - start;
    const Scalar part = t * motion;
    const Scalar place = start + part;
    query.x[half + i] = static_cast<double>(place);
    is_finite = is_finite && std::isfinite(place);
  }
  return is_finite;
}

}  // namespace

std::optional<Query> committed_step(const Query& query, double time, bool in_float) {
  Query step = query;
  const bool is_finite = in_float ? move_end<float>(step, time) : move_end<double>(step, time);
  return is_finite ? std::optional(step) : std::nullopt;
}

StepEnd end_of(const Query& step) {
  auto earliest = earliest_time(step);
  if (!earliest) return StepEnd::free;
  return earliest->makes_late(1) ? StepEnd::touches : StepEnd::touches_at_end;
}

}  // namespace nearmiss
