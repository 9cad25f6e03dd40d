// A number is written as a decimal only if the decimal is exact, and every written number is read back with
// the same bits.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <sstream>

#include "corpus/case.hpp"
#include "corpus/query_text.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

TEST(Numbers, AreDecimalsIfTheseAreExact) {
  EXPECT_EQ(to_exact(0), "0");
  EXPECT_EQ(to_exact(-0.0), "-0");
  EXPECT_EQ(to_exact(2), "2");
  EXPECT_EQ(to_exact(-0.25), "-0.25");
  EXPECT_EQ(to_exact(100), "100");
  EXPECT_EQ(to_exact(0x1p53), "9007199254740992");
  EXPECT_EQ(to_exact(1e22), "1e+22");
}

TEST(Numbers, AreHexFloatsIfTheirShortestDecimalIsNotExact) {
  EXPECT_EQ(to_exact(0.1), "0x1.999999999999ap-4");
  EXPECT_EQ(to_exact(-1e300), "-0x1.7e43c8800759cp+996");
  EXPECT_EQ(to_exact(0x1p-53), "0x1p-53");
  EXPECT_EQ(to_exact(0x1p56), "0x1p+56");  // 72057594037927936; its shortest decimal ends in 40
  EXPECT_EQ(to_exact(std::numeric_limits<double>::denorm_min()), "0x0.0000000000001p-1022");
  EXPECT_EQ(to_exact(std::numeric_limits<double>::max()), "0x1.fffffffffffffp+1023");
}

TEST(Numbers, AreReadBackBitForBit) {
  std::uint64_t bits = 1;
  for (int i = 0; i < 20000; ++i) {
    bits = bits * 6364136223846793005U + 1442695040888963407U;  // Knuth's generator
    const double any = std::bit_cast<double>(bits);
    const double few = std::ldexp(static_cast<double>(bits >> 55) - 256, i % 40 - 30);
    for (const double value : {any, few})
      if (std::isfinite(value)) {
        const double back = parse_number(to_exact(value), "here");
        EXPECT_EQ(std::bit_cast<std::uint64_t>(back), std::bit_cast<std::uint64_t>(value)) << to_hex(value);
      }
  }
}

TEST(Numbers, OfAQueryAreShownInGroups) {
  Query query = testing::falling_vertex(0.25, 0.25, 2, -1);
  EXPECT_EQ(to_readable(query), "0.25 0.25 2  0 0 0  1 0 0  0 1 0   0.25 0.25 -1  0 0 0  1 0 0  0 1 0");
  query.x[0] = 0.1;
  EXPECT_EQ(to_readable(query),
            "0.1 0.25 2  0 0 0  1 0 0  0 1 0   0.25 0.25 -1  0 0 0  1 0 0  0 1 0\n" + to_line(query));
}

TEST(Numbers, OfACaseAreExact) {
  Case each{.name = {},
            .query = testing::falling_vertex(0.1, 0.25, 2, -1),
            .truth = {},
            .why = {},
            .provenance = {}};
  each.query.x[5] = -0.0;
  const std::string text = to_text(each);
  EXPECT_NE(text.find("\nx0 0x1.999999999999ap-4 0.25 2\nx1 0 0 -0\n"), std::string::npos) << text;
  std::istringstream in(text);
  EXPECT_EQ(to_line(parse_case(in, "here").query), to_line(each.query));
}

}  // namespace
}  // namespace nearmiss
