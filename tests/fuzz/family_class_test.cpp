// Every family has the class that its queries deserve: the criterion of fuzz/families/README.md, as far as it is one
// of sizes.
#include "reports/statistics/family_class.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "tests/fuzz/family_queries.hpp"

namespace nearmiss {
namespace {

/// The largest component of a vector.
double largest_component(const Vector3<double>& v) { return v.cwiseAbs().maxCoeff(); }

/// The length of the longest edge and of the shortest one that is not zero, at either time.
struct Lengths {
  double longest = 0;
  double shortest = 0;
};

Lengths lengths(const Query& query) {
  Lengths found;
  for (const int time : {0, 1})
    for (const auto& edge : testing::edges(query, time)) {
      const double length = largest_component(edge);
      found.longest = std::max(found.longest, length);
      if (length > 0) found.shortest = found.shortest == 0 ? length : std::min(found.shortest, length);
    }
  return found;
}

double fastest(const Query& query) {
  double speed = 0;
  for (int i = 0; i < 4; ++i) speed = std::max(speed, largest_component(query.end(i) - query.start(i)));
  return speed;
}

/// Whether sizes differ by more than 10^8, or a coordinate is outside 1e-30 .. 1e30.
bool is_extreme(const Query& query) {
  constexpr double most = 1e8;
  const Lengths length = lengths(query);
  const double largest = testing::largest_coordinate(query);
  if (largest != 0 && !(1e-30 < largest && largest < 1e30)) return true;
  if (length.longest == 0) return false;  // points have no size
  return length.longest > most * length.shortest || fastest(query) > most * length.longest ||
         largest > most * length.longest;
}

TEST(FamilyClass, AFamilyIsExtremeIfATenthOfItsQueriesAre) {
  for (const Family& family : all_families()) {
    const int extreme = testing::count_of_400(family.name, is_extreme);
    std::cout << family.name << ": " << extreme << " of 400 are extreme\n";
    EXPECT_EQ(class_of(family.name) == FamilyClass::extreme, extreme >= 40) << family.name << ' ' << extreme;
  }
}

/// Whether two points coincide, an edge rests, or edges are parallel up to 1e-6.
bool is_degenerate(const Query& query) {
  for (const int time : {0, 1}) {
    const auto all = testing::edges(query, time);
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (largest_component(all[i].cross(all[j])) <=
            1e-6 * largest_component(all[i]) * largest_component(all[j]))
          return true;
  }
  return fastest(query) == 0;
}

TEST(FamilyClass, AnOrdinaryFamilyIsInGeneralPosition) {
  for (const Family& family : all_families())
    if (class_of(family.name) == FamilyClass::ordinary) {
      EXPECT_LT(testing::count_of_400(family.name, is_degenerate), 40) << family.name;
    }
}

TEST(FamilyClass, EveryFamilyHasOne) {
  for (const Family& family : all_families())
    EXPECT_NE(class_of(family.name), FamilyClass::unclassified) << family.name;
  EXPECT_EQ(class_of("mesh"), FamilyClass::ordinary);
}

}  // namespace
}  // namespace nearmiss
