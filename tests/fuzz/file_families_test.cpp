// The families of coordinates as files have them keep their promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "fuzz/families/contacts.hpp"
#include "tests/fuzz/family_queries.hpp"

namespace nearmiss {
namespace {

using testing::count_of_400;
using testing::edges;
using testing::largest_coordinate;

template <class Property>
bool all_coordinates(const Query& query, const Property& has_property) {
  return std::all_of(query.x.begin(), query.x.end(), has_property);
}

TEST(Floats, EveryCoordinateIsAFloat) {
  const auto is_float = [](double c) { return static_cast<double>(static_cast<float>(c)) == c; };
  EXPECT_EQ(count_of_400("floats", [&](const Query& query) { return all_coordinates(query, is_float); }),
            400);
}

TEST(Decimals, EveryCoordinateIsTheDoubleNearestToADecimal) {
  for (const int digits : {1, 3, 6}) {
    const auto is_decimal = [&](double c) {
      char text[64];
      std::snprintf(text, sizeof text, "%.*f", digits, c);
      return std::stod(text) == c;
    };
    EXPECT_EQ(count_of_400("decimals@" + std::to_string(digits),
                           [&](const Query& query) { return all_coordinates(query, is_decimal); }),
              400)
        << digits;
  }
}

TEST(Kilometres, PrimitivesAreFarSmallerThanTheScene) {
  const int small = count_of_400("kilometres", [](const Query& query) {
    double longest = 0;
    for (const auto& edge : edges(query, 0)) longest = std::max(longest, edge.norm());
    return 1e-4 < longest && longest < 1 && largest_coordinate(query) < 10001;
  });
  EXPECT_EQ(small, 400);
  EXPECT_GT(count_of_400("kilometres", [](const Query& query) { return largest_coordinate(query) > 100; }),
            380);
}

}  // namespace
}  // namespace nearmiss
