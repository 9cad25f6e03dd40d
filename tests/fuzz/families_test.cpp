// A family is a pure function. Its queries have finite numbers, and keep the promises of the family's
// description.
#include "fuzz/families/families.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "oracle/oracle.hpp"
#include "tests/bit_hash.hpp"
#include "tests/refused.hpp"

namespace nearmiss {
namespace {

TEST(Random, IsPhilox4x64) {
  // The known answer from the test vectors of Philox's authors (kat_vectors: philox4x64 10, all zero).
  Random random(0, 0, 0);
  EXPECT_EQ(random.bits(), 0x16554d9eca36314cU);
  EXPECT_EQ(random.bits(), 0xdb20fe9d672d0fdcU);
  EXPECT_EQ(random.bits(), 0xd7e772cee186176bU);
  EXPECT_EQ(random.bits(), 0x7e68b68aec7ba23bU);
}

/// The number of queries to check: the usual number, or a fifth for families that compute exact distances,
/// such as near-separation.
std::uint64_t count_of(const Family& family, std::uint64_t usual) {
  return family.has_separation && family.block_cases < 25 ? usual / 5 : usual;
}

/// A hash of the first queries, including the separations of queries that have one.
std::uint64_t fingerprint(const Family& family) {
  testing::BitHash hash;
  for (std::uint64_t i = 0; i < count_of(family, 1000); ++i) {
    const Query query = make_query(family, 1, i);
    hash.add_all(query.x);
    if (family.has_separation) hash.add(query.separation);
  }
  return hash.value();
}

// With every compiler, a provenance must always give the same query. On processors without fused
// multiply-add, families that draw log-uniform numbers make other queries.
TEST(EveryFamily, MakesTheQueriesThatItAlwaysMade) {
  const std::map<std::string, std::uint64_t> recorded{
      {"uniform", 0x9d788afc3f9872d2},
      {"uniform-end", 0x51bdb7ca97be4040},
      {"uniform-slow", 0xf2b2d27702261e8f},
      {"planted", 0x203e0fd07c7149f5},
      {"planted-ulp", 0x07a4320769488cd8},
      {"grazing", 0x21f88a893ea1f500},
      {"parallel", 0x316a1560d9b96f5c},
      {"small", 0xbc7ce221d18f80dd},
      {"sliver", 0x8f6615bf8edcd37a},
      {"planar", 0x79b70d5d5080ceee},
      {"small-integer", 0x5ff28ae8897b3d34},
      {"unit-integer", 0xfdfecb83791de02f},
      {"degenerate", 0x09b99353cfe012e2},
      {"stiff", 0x2802db844ad3bd2f},
      {"aspect", 0x4d28aa5db5fd6a9e},
      {"offset", 0x05e37fc9d951f87f},
      {"scale", 0x5aa35df3456daed4},
      {"mixed-scale", 0x14306776b39a0863},
      {"near-parallel-edges", 0xf707b572d0cb008f},
      {"needle", 0xda7cdbd684870c07},
      {"static-pair", 0x81d5de92dc5bd650},
      {"rigid", 0x6fdd9a1b546dcb3a},
      {"end-contact", 0x580f7ad495da72ff},
      {"even-roots", 0xf83c1c8571aac442},
      {"triple-root", 0x5608c495f14a33f1},
      {"overflow", 0xbdfadc35c5f6dd06},
      {"near-overflow", 0x1872a4afd1add163},
      {"near-overflow-planted", 0x77b1879b5edcd824},
      {"near-underflow", 0x4bbbe4335c45df41},
      {"near-underflow-planted", 0x7255a98084a399c3},
      {"far-end", 0x4b2b59a3cde82f9d},
      {"far-start", 0xddebb4aea95ed945},
      {"first-moment", 0x186b0b5629aba45d},
      {"one-point", 0x429c7d6af703742d},
      {"touch-twice", 0xd145e8e108ba29d1},
      {"floats", 0x59180ea657a2c7ee},
      {"decimals", 0x9cdb8cd07a10ba70},
      {"kilometres", 0x37d61b6499585f56},
      {"metres", 0x6839316e8bbb2db9},
      {"units", 0x54778f4b727eec6e},
      {"distant", 0xde8837de4463cd22},
      {"crossed", 0xcab21eb5732a81f7},
      {"close-roots", 0x45abc9ca22a03501},
      {"touch-once", 0xfe38bc47ae1c2d3d},
      {"border-first", 0x062bfffb8b6ef561},
      {"return-later", 0xadb823a490b3e4e3},
      {"slow-contact", 0x96d28047f25f38f3},
      {"near-separation", 0x24a01d6bcce08c19},
      {"tied-separation", 0xa892ad82ed1a1ba4},
      {"reached-separation", 0xad2ab4fac1bdb585},
      {"slow-approach", 0x717f8d2ed3af15af},
      {"changed-features", 0x1604004ba4005edd},
      {"starts-near-separation", 0x5f887d5ffd78f1e9},
      {"sized-separation", 0x81a1cbd9d10f56c3},
      {"v-minimum", 0xbebebebb776da25a},
      {"v-along", 0xbe02162f23a8f85a},
      {"v-shrinking", 0xa5e0f48e28de8be3},
      {"v-drifting", 0x72e69fb08a7cd9f0},
      {"v-near-separation", 0xb702d8d61adf0f7a},
      {"v-tied-separation", 0xa93676cc5824bcf9},
      {"v-reached-separation", 0x02201f60bea5e930},
      {"v-slow-approach", 0x560ce26cf7ee7ede},
      {"v-starts-near-separation", 0x84b54c49f9abc2c2},
      {"v-sized-separation", 0xa1535797e380db52},
      {"v-uniform", 0x6d328962c252edd2},
      {"v-uniform-slow", 0x75d8606932b90b2b},
      {"v-floats", 0x328cd34d290c3254},
      {"v-kilometres", 0xf3ae89e8efb04ff6},
      {"v-metres", 0x5b95a5c23c0cb4f9},
      {"v-units", 0x37ecd430c82af788},
      {"v-distant", 0x378f417c160631c0},
      {"v-small-integer", 0x842c8f3a2d35b014},
      {"v-decimals", 0x94774d1e01601cfd},
      {"v-rigid", 0xc2859bce67534fd8},
      {"v-one-point", 0xefac3d7d680258ab},
      {"v-degenerate", 0x2f3fbe5a8bd023ad},
      {"v-small", 0x4b515ee648416948},
      {"v-stiff", 0x05fabc5d4971a1f9},
      {"rest", 0xdcf17ef277ccc5c4},
      {"rest-touching", 0xa47fa4ec3c6d0a75},
      {"rest-units", 0x5b80d3ef051a1189},
      {"rest-distant", 0xa752a47bdb616e22},
      {"rest-angle", 0x4d6774d29a078574},
      {"rest-ratio", 0x229d2ee153762b76},
      {"v-rest", 0xa24106ac6afbf279},
      {"v-rest-touching", 0xb6097aef1e9b5a2a},
      {"v-rest-units", 0xc6d094e67f67ece9},
      {"v-rest-distant", 0x010b366c091e42e5},
      {"v-rest-angle", 0x9527cbe82f51f64b},
      {"v-rest-ratio", 0xd0b392931f375fd2},
      {"v-offset", 0xe96aae05380f6151},
      {"v-scale", 0xf45b7b6b5bd067c0},
      {"v-mixed-scale", 0x87168220bdacdb80},
      {"v-static-pair", 0x7f8703096cd22e25},
      {"v-near-overflow", 0xbaf6be069465f718},
      {"v-overflow", 0xcae47f0d36ff97fa},
      {"v-near-underflow", 0xbd46395370ce4c68},
  };
  for (const Family& family : all_families()) {
    const Query later = make_query(family, 1, 1000);
    const std::uint64_t found = fingerprint(family);
    EXPECT_EQ(found, recorded.contains(family.name) ? recorded.at(family.name) : 0)
        << family.name << ' ' << std::hex << found;
    EXPECT_EQ(make_query(family, 1, 1000), later) << family.name;
    EXPECT_NE(make_query(family, 2, 1000), later) << family.name;
  }
}

void expect_finite_and_of_both_kinds(const Family& family) {
  for (std::uint64_t i = 0; i < count_of(family, 300); ++i) {
    const Query query = make_query(family, 3, i);
    ASSERT_TRUE(is_finite(query)) << family.name << ' ' << i;
    ASSERT_TRUE(std::isfinite(query.separation)) << family.name << ' ' << i;
    ASSERT_EQ(query.separation > 0, family.has_separation) << family.name << ' ' << i;
    ASSERT_EQ(query.kind, family.kinds[i % 2]) << i;
    Query repeating = query;
    repeat_vertices(repeating);
    ASSERT_EQ(query, repeating) << "vertices beyond the last one, " << family.name << ' ' << i;
  }
}

TEST(EveryFamily, IsFiniteAndOfBothKinds) {
  for (const Family& family : all_families())
    if (family.parameter)
      for (const Family& step : sweep(family, 3)) expect_finite_and_of_both_kinds(step);
    else
      expect_finite_and_of_both_kinds(family);
}

// Only families of planted collisions may always collide. Any other family is useless if its queries always
// collide, or hardly ever do.
TEST(EveryFamily, HasCollisionsAndMisses) {
  for (const Family& family : all_families()) {
    if (!is_of_meshes(family.kinds[0]) && !family.has_separation) continue;  // contact is a coincidence
    const std::uint64_t count = count_of(family, 400);
    std::uint64_t collisions[2] = {0, 0};
    for (std::uint64_t i = 0; i < 2 * count; ++i) collisions[i % 2] += collides(make_query(family, 4, i));
    // In uniform-slow, about 3 queries in 1000 collide. In the families whose primitives are at rest, no
    // query collides, except in rest-touching.
    const bool has_few =
        family.name == "uniform-slow" || (family.name.starts_with("rest") && family.name != "rest-touching");
    for (const std::uint64_t c : collisions) {
      EXPECT_GE(c, family.planted ? count : has_few ? 0 : count / 50) << family.name;
      EXPECT_LE(c, family.planted ? count : count - count / 50) << family.name;
    }
  }
}

// --- parameters -----------------------------------------------------------------------------------------

/// A family in which x[0] of each query is the value of the parameter.
Family telling_family() {
  return with_parameter("telling", "", {"", -3, 5, false, [](Random& random, Kind kind, double x) {
                                          Query query{.kind = kind};
                                          query.x[0] = x;
                                          query.x[1] = random.uniform();
                                          return query;
                                        }});
}

TEST(Parameter, IsDrawnFromItsWholeRange) {
  double lo = 5;
  double hi = -3;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const double x = make_query(telling_family(), 1, i).x[0];
    lo = std::min(lo, x);
    hi = std::max(hi, x);
  }
  EXPECT_GE(lo, -3);
  EXPECT_LT(lo, -2.9);
  EXPECT_LE(hi, 5);
  EXPECT_GT(hi, 4.9);
}

TEST(Parameter, AFixedValueMakesTheQueryThatIsMadeWhereItIsDrawn) {
  for (std::uint64_t i = 0; i < 10; ++i) {
    const Query drawn = make_query(telling_family(), 1, i);
    EXPECT_EQ(make_query(at_value(telling_family(), drawn.x[0]), 1, i), drawn);
  }
}

TEST(Parameter, AProvenanceNamesTheValue) {
  const Family family = find_family("aspect@8");
  EXPECT_EQ(family.name, "aspect@8");
  EXPECT_EQ(find_family("aspect@8.0").name, "aspect@8");
  EXPECT_EQ(make_query(family, 3, 7), make_query(at_value(find_family("aspect"), 8), 3, 7));
  EXPECT_NE(make_query(family, 3, 7), make_query(find_family("aspect@9"), 3, 7));
}

TEST(Parameter, ASweepHasBothEndsAndEachWholeNumberOnce) {
  std::vector<std::string> names;
  for (const Family& step : sweep(find_family("stiff"), 5)) names.push_back(step.name);
  EXPECT_THAT(names, ::testing::ElementsAre("stiff@-16", "stiff@-8", "stiff@0", "stiff@8", "stiff@16"));
  const auto steps = sweep(find_family("end-contact"), 1000);
  EXPECT_EQ(steps.size(), 65);
  EXPECT_EQ(steps.front().name, "end-contact@0");
  EXPECT_EQ(steps.back().name, "end-contact@64");
}

TEST(Parameter, BadNamesAndValuesAreNamed) {
  EXPECT_REFUSED(find_family("aspekt@8"), "unknown family 'aspekt', expected one of uniform, ");
  EXPECT_REFUSED(find_family("aspect@17"),
                 "found the family 'aspect@17', expected a number from 0 to 16 behind the @");
  EXPECT_REFUSED(find_family("scale@0.5"),
                 "found the family 'scale@0.5', expected a whole number from -1074 to 1023");
  EXPECT_REFUSED(find_family("aspect@x"), "found 'x', expected a finite number");
  EXPECT_REFUSED(find_family("uniform@1"), "found the family 'uniform', expected one with a parameter");
  EXPECT_REFUSED(sweep(find_family("uniform"), 3),
                 "found the family 'uniform', expected one with a parameter");
}

}  // namespace
}  // namespace nearmiss
