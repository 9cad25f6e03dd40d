// The families at the limits of double's range keep their promises.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "oracle/features.hpp"
#include "tests/fuzz/family_queries.hpp"

namespace nearmiss {
namespace {

using testing::count_of_400;
using ::testing::HasSubstr;
using testing::largest_coordinate;

/// The sum of the magnitudes of F's products of three differences from x0. If `left_out` is an axis, the
/// products are those of two differences in the weights' component for that axis. It does not overflow an x87
/// long double.
long double sum_of_products(const Query& query, std::size_t left_out) {
  const auto difference = [&](std::size_t vertex, std::size_t k) -> long double {
    const auto v = static_cast<int>(vertex);
    const auto i = static_cast<int>(k);
    return std::max(std::abs(query.start(v)[i] - query.start(0)[i]),
                    std::abs(query.end(v)[i] - query.end(0)[i]));
  };
  long double sum = 0;
  std::array<std::size_t, 3> axis{0, 1, 2};
  do {
    long double product = 1;
    for (std::size_t v = 0; v < 3; ++v) product *= axis[v] == left_out ? 1 : difference(v + 1, axis[v]);
    sum += product;
  } while (std::next_permutation(axis.begin(), axis.end()));
  return sum;
}

/// Whether one of these sums, or its square, has the magnitude that the parameter gives.
bool products_are_about(const Query& query, int x) {
  const auto is_about = [](long double sum, int exponent) {
    const long double size = std::ldexp(sum, -exponent);
    return 1 - 1e-12L < size && size < 2 + 1e-12L;  // a coordinate may have been moved by ulps
  };
  for (std::size_t left_out = 0; left_out < 4; ++left_out) {
    const long double sum = sum_of_products(query, left_out);
    if (is_about(sum, x) || is_about(sum, static_cast<int>(std::floor(x / 2.0)))) return true;
  }
  return false;
}

TEST(Range, ProductsAreAsLargeAsTheParameterSays) {
  for (const auto& [name, parameters] : {std::pair("near-overflow", std::vector{1016, 1023, 1024, 1025}),
                                         {"near-underflow", {-1090, -1074, -1022, -1006}}})
    for (const std::string end : {"", "-planted"})
      for (const int x : parameters)
        testing::expect_more(testing::at(name + end, x), 380,
                             [x](const Query& query) { return products_are_about(query, x); });
}

TEST(Range, CoordinatesAreOfEverySizeThatProductsOverflowAt) {
  const auto between = [&](double lo, double hi) {
    return count_of_400("near-overflow@1023", [&](const Query& query) {
      const double largest = largest_coordinate(query);
      return lo <= largest && largest < hi;
    });
  };
  EXPECT_GT(between(0x1p165, 0x1p173), 4);    // products of six
  EXPECT_GT(between(0x1p250, 0x1p258), 4);    // of four
  EXPECT_GT(between(0x1p335, 0x1p344), 100);  // of three
  EXPECT_GT(between(0x1p505, 0x1p514), 10);   // of two
  EXPECT_GT(between(0x1p514, 0x1p1000), 10);  // of sizes far apart
}

TEST(Range, SomeOfTheSumsOverflowAndOthersDoNot) {
  const auto overflowing = [](int x) {
    return count_of_400("near-overflow@" + std::to_string(x), [](const Query& query) {
      return sum_of_products(query, 3) > std::numeric_limits<double>::max();
    });
  };
  // Products of three overflow only in queries whose products of two are near 2^1023.
  EXPECT_LT(overflowing(1023), 100);
  EXPECT_GT(overflowing(1024), 200);
}

TEST(Range, ContactIsPlantedAtEveryTimeAndPlace) {
  for (const char* name : {"near-overflow-planted", "near-underflow-planted"}) {
    std::string seen;
    for (const Query& query : testing::first_queries(name, 400, 5))
      seen += to_text(query.kind, contact_features(query).value()) + "\n";
    for (const char* feature : {"simple-root", "multiple-root", "planar", "at-start", "inside", "at-end",
                                "in-face", "on-edge", "on-vertex", "crossing", "end-on-edge", "end-on-end"})
      EXPECT_THAT(seen, HasSubstr(feature)) << name;
  }
}

TEST(Range, EveryQueryIsDecidedByAllMethods) {
  for (const Family& family : families())
    EXPECT_EQ(family.compare_all,
              family.name.starts_with("near-overflow") || family.name.starts_with("near-underflow"))
        << family.name;
  EXPECT_TRUE(find_family("near-overflow@1023").compare_all);
  EXPECT_TRUE(find_family("near-overflow-planted@1023").planted);
  EXPECT_EQ(find_family("near-overflow@1023").block_cases, find_family("near-overflow").block_cases);
}

}  // namespace
}  // namespace nearmiss
