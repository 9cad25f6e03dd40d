// The families NAME~H and NAME~drawn. Queries of the family NAME, which ask for contact, get a separation: H,
// or one that is drawn for each query.
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "fuzz/families/contacts.hpp"
#include "fuzz/families/families.hpp"
#include "tests/refused.hpp"

namespace nearmiss {
namespace {

TEST(WithSeparation, OnlyTheSeparationChanges) {
  for (const char* family : {"uniform", "aspect", "aspect@8", "one-point", "crossed"})
    for (std::uint64_t i = 0; i < 100; ++i) {
      const Query query = make_query(find_family(family), 3, i);
      EXPECT_EQ(query.separation, 0);
      EXPECT_EQ(make_query(find_family(std::string(family) + "~0.125"), 3, i), with_separation(query, 0.125));
      EXPECT_EQ(make_query(find_family(std::string(family) + "~drawn"), 3, i).x, query.x);
    }
}

TEST(WithSeparation, DrawnIsFromAMillionthOfTheExtentToAllOfItAndOftenAPowerOfTwo) {
  int powers_of_two = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const Query query = make_query(find_family("stiff~drawn"), 5, i);
    const double ratio = query.separation / extent(query);
    // The limit is half of 1e-6, because some separations are rounded down to a power of two.
    EXPECT_LE(0.5e-6, ratio);
    EXPECT_LE(ratio, 1);
    powers_of_two += std::ldexp(1, std::ilogb(query.separation)) == query.separation ? 1 : 0;
  }
  EXPECT_GT(powers_of_two, 60);
  for (const char* family : {"one-point~drawn", "overflow~drawn", "scale@-1074~drawn", "scale@1023~drawn"})
    for (std::uint64_t i = 0; i < 200; ++i) {
      const double h = make_query(find_family(family), 1, i).separation;
      EXPECT_TRUE(0 < h && std::isfinite(h)) << family << ' ' << i;
    }
}

TEST(WithSeparation, ASweepNamesTheValueBeforeTheSeparation) {
  for (const char* separation : {"~drawn", "~0.5"}) {
    const Family family = find_family(std::string("stiff") + separation);
    std::vector<std::string> names;
    for (const Family& step : sweep(family, 3)) names.push_back(step.name);
    const std::string end = separation;
    EXPECT_THAT(names, ::testing::ElementsAre("stiff@-16" + end, "stiff@0" + end, "stiff@16" + end));
    for (const Family& step : sweep(family, 3))
      for (std::uint64_t i = 0; i < 20; ++i)
        EXPECT_EQ(make_query(step, 1, i), make_query(find_family(step.name), 1, i)) << step.name;
  }
}

TEST(WithSeparation, BadSeparationsAreNamed) {
  EXPECT_REFUSED(find_family("uniform~0"),
                 "family 'uniform~0': found the separation 0, expected a positive number or drawn");
  EXPECT_REFUSED(find_family("uniform~-1"), "family 'uniform~-1': found the separation -1, expected ");
  EXPECT_REFUSED(find_family("uniform~inf"), "family 'uniform~inf': found 'inf', expected ");
  EXPECT_REFUSED(find_family("uniform~"), "family 'uniform~': found '', expected ");
  EXPECT_REFUSED(find_family("uniform~1~1"), "family 'uniform~1~1': found '1~1', expected ");
  EXPECT_REFUSED(find_family("aspect~drawn@8"), "family 'aspect~drawn@8': found 'drawn@8', expected ");
  EXPECT_REFUSED(find_family("aspect@17~1"),
                 "found the family 'aspect@17', expected a number from 0 to 16 behind the @");
  EXPECT_REFUSED(find_family("uniforms~1"), "unknown family 'uniforms', expected one of uniform, ");
  for (const Family& family : separation_families())
    EXPECT_REFUSED(
        find_family(family.name + "~1"),
        "family '" + family.name + "~1': found a separation, expected none: the family has its own");
}

}  // namespace
}  // namespace nearmiss
