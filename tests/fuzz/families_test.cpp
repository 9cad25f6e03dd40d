// Families: pure functions, finite, true to their promises.
#include "fuzz/families.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <string>

#include "oracle/oracle.hpp"

namespace nearmiss {

/// How a parameter is printed in a test's name.
void PrintTo(const Family& family, std::ostream* out) { *out << family.name; }

namespace {

class EveryFamily : public ::testing::TestWithParam<Family> {};
INSTANTIATE_TEST_SUITE_P(All, EveryFamily, ::testing::ValuesIn(families().begin(), families().end()),
                         [](const auto& each) {
                           std::string name(each.param.name);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(Random, IsPhilox4x64) {
  // Known answer of the authors' test vectors (kat_vectors: philox4x64 10, all zero).
  Random random(0, 0, 0);
  EXPECT_EQ(random.bits(), 0x16554d9eca36314cU);
  EXPECT_EQ(random.bits(), 0xdb20fe9d672d0fdcU);
  EXPECT_EQ(random.bits(), 0xd7e772cee186176bU);
  EXPECT_EQ(random.bits(), 0x7e68b68aec7ba23bU);
}

TEST_P(EveryFamily, IsAPureFunctionOfSeedAndIndex) {
  const Query later = make_query(GetParam(), 1, 1000);
  for (std::uint64_t i = 0; i < 10; ++i) (void)make_query(GetParam(), 1, i);
  EXPECT_EQ(make_query(GetParam(), 1, 1000), later);
  EXPECT_NE(make_query(GetParam(), 2, 1000), later);
  EXPECT_NE(make_query(GetParam(), 1, 1002), later);
}

TEST_P(EveryFamily, IsFiniteAndOfBothKinds) {
  for (std::uint64_t i = 0; i < 10000; ++i) {
    const Query query = make_query(GetParam(), 3, i);
    ASSERT_TRUE(is_finite(query)) << i;
    ASSERT_EQ(query.kind, kinds[i % 2]) << i;
  }
}

// A family that hardly ever collides, or always, hunts for nothing (but for planted collisions).
TEST_P(EveryFamily, HasCollisionsAndMisses) {
  constexpr int count = 1000;
  int collisions[2] = {0, 0};
  for (std::uint64_t i = 0; i < 2 * count; ++i) collisions[i % 2] += collides(make_query(GetParam(), 4, i));
  for (const int c : collisions) {
    RecordProperty("collisions_of_1000", c);
    if (GetParam().planted) {
      EXPECT_EQ(c, count);
    } else {
      const int least = GetParam().name == "uniform-slow" ? 0 : count / 50;  // about 3 in 1000 there
      EXPECT_GE(c, least);
      EXPECT_LE(c, count - count / 50);
    }
  }
  std::cout << GetParam().name << ": " << collisions[0] << " of 1000 vt, " << collisions[1]
            << " of 1000 ee collide\n";
}

}  // namespace
}  // namespace nearmiss
