#include "reports/statistics/query_class.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace nearmiss {

namespace {

using Point = std::array<double, 3>;

/// The vertices at t = 0, then at t = 1.
std::array<Point, 8> points(const Query& query) {
  std::array<Point, 8> all{};
  for (std::size_t i = 0; i < 24; ++i) all[i / 3][i % 3] = query.x[i];
  return all;
}

bool coincide(std::span<const Point> all) {
  for (std::size_t i = 0; i < all.size(); ++i)
    if (std::ranges::find(all.first(i), all[i]) != all.first(i).end()) return true;
  return false;
}

}  // namespace

int exoticness(const Query& query, QueryClass of) {
  const auto all = points(query);
  const auto count = static_cast<std::size_t>(vertices(query.kind));
  const auto at = [&](std::size_t time) { return std::span(all).subspan(4 * time, count); };
  const int of_coincident = coincide(at(0)) || coincide(at(1)) ? 1 : 0;
  switch (of) {
    case QueryClass::ordinary:
      return 0;
    case QueryClass::degenerate:
      if (std::count(all.begin(), all.end(), all[0]) == 8) return 3;
      return 1 + of_coincident;
    case QueryClass::extreme:
      return 4 + of_coincident;
    case QueryClass::unclassified:
      break;
  }
  return 6;
}

}  // namespace nearmiss
