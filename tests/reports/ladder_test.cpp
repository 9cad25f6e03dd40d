// The ladder of precisions.
#include "reports/sections/ladder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "ccd/query/scalar_name.hpp"
#include "reports/sections/sections.hpp"
#include "reports/text/json.hpp"

namespace nearmiss {
namespace {

using ::testing::HasSubstr;

/// Statistics in which the farthest false positive of each subject is at a given fraction of its bound.
Statistics farthest_at(const std::map<std::string, double>& parts) {
  Statistics statistics;
  for (const auto& [subject, part] : parts) {
    const Outcome outcome{.verdict = Verdict::accepted(Stage::vv, 0), .collision = false, .ratio = part};
    statistics.counts[{subject, Kind::edge_edge, "uniform"}].add(outcome, {}, [] { return "uniform:1:1"; });
  }
  return statistics;
}

/// The fit over all families; null if there is none.
nlohmann::ordered_json fit(const std::map<std::string, double>& parts) {
  const auto all = ladder_json(farthest_at(parts))["fits"];
  return all.empty() ? nlohmann::ordered_json() : all[0];
}

TEST(ScalarName, GivesEpsilon) {
  EXPECT_EQ(epsilon_exponent_of("float"), -23);
  EXPECT_EQ(epsilon_exponent_of(""), -52);
  EXPECT_EQ(epsilon_exponent_of("p40"), -39);
  for (const char* other : {"p", "p1", "p257", "p999999999", "p40x", "half", "-3"})
    EXPECT_EQ(epsilon_exponent_of(other), std::nullopt);
  EXPECT_EQ(split_scalar("wang-tight:p40@0.5").algorithm, "wang-tight");
  EXPECT_EQ(split_scalar("wang-tight:p40@0.5").scalar, "p40");
}

TEST(Ladder, RungsHaveTheBoundOfTheirTolerances) {
  const auto all = ladder_json(farthest_at(
      {{"wang", 0.5}, {"wang:float", 1}, {"wang-tight:p53", 1}, {"basic", 1}, {"wang:p40@7", 1}}))["rungs"];
  ASSERT_EQ(all.size(), 3);
  EXPECT_EQ(all[0]["subject"], "wang:float");
  EXPECT_NEAR(all[0]["claimed"], 41 * std::exp2(-23 / 4.0), 5e-3);
  EXPECT_EQ(all[1]["scalar"], "double");
  EXPECT_NEAR(all[1]["claimed"], 40.963 * 0x1p-13, 1e-7);
  EXPECT_EQ(all[1]["farthest"], all[1]["claimed"].get<double>() / 2);
  EXPECT_NEAR(all[2]["claimed"], 11.9336 * 0x1p-13, 1e-7);
}

TEST(Ladder, ASubjectOnNoLadderIsAnAlgorithmOfItsOwn) {
  EXPECT_EQ(place_of("wang:p40").algorithm, "wang");
  EXPECT_EQ(place_of("wang:p40").scalar, "p40");
  for (const char* name : {"wang-eps", "wang-eps:h=0.001", "wang-scalar", "bridson:thickness=1"})
    EXPECT_NEAR(*place_of(name).unit, 40.963 * 0x1p-13, 1e-7) << name;
  EXPECT_EQ(place_of("wang-eps:h=0.001").algorithm, "wang-eps:h=0.001");
  EXPECT_EQ(place_of("wang:p40@7").algorithm, "wang@7");
  EXPECT_EQ(place_of("wang:p40@7").unit, std::nullopt);  // the name gives the bound B
  for (const char* other :
       {"exact", "defect:vv", "./plugin.so", "additive:rescaling=0.5", "wang-eps:h=0.001@7"}) {
    EXPECT_EQ(place_of(other).algorithm, other);
    EXPECT_EQ(place_of(other).unit, std::nullopt);
  }
}

TEST(Ladder, TheFitIsTheSlopeOfTheLogarithms) {
  const std::map<std::string, double> parts{
      {"wang:p24", 1}, {"wang:p40", 1}, {"wang:p64", 1}, {"wang:p128", 1}};
  const auto line = fit(parts);
  EXPECT_EQ(line["points"], 4);
  EXPECT_EQ(line["precisions"], 4);
  EXPECT_NEAR(line["exponent"], 0.25, 1e-6);
  EXPECT_NEAR(line["standard_error"], 0, 1e-6);
  EXPECT_EQ(line["least_part_of_claimed"], 1);
  EXPECT_EQ(line["greatest_part_of_claimed"], 1);
  EXPECT_EQ(line["restates_the_bound"], true);
  EXPECT_THAT(
      ladder_table(farthest_at(parts)),
      HasSubstr(
          "\nwang: the farthest are at 1 to 1 of the claimed distance for 4 subjects with 4 precisions\n"));
  // If the distances halve once more for each halving of ε, the exponent grows by one.
  EXPECT_NEAR(fit({{"wang:p24", 1}, {"wang:p28", 0x1p-4}, {"wang:p32", 0x1p-8}})["exponent"], 1.25, 1e-4);
  for (const char* no_third : {"wang:p200", "wang:float"})
    EXPECT_TRUE(fit({{"wang:p24", 1}, {"wang:p28", 1}, {no_third, 1}}).is_null());
}

// The 0.975 quantile of t with two degrees of freedom is 0.95 √(2 / (4 · 0.975 · 0.025)).
TEST(Ladder, TheIntervalIsStudents) {
  const std::map<std::string, double> parts{
      {"wang:p24", 0.5}, {"wang:float", 0.25}, {"wang:p32", 1}, {"wang:p64", 0.125}};
  const auto line = fit(parts);
  EXPECT_EQ(line["points"], 4);
  EXPECT_EQ(line["precisions"], 3);
  EXPECT_NEAR(line["half_width_95"], 4.302652729749464 * line["standard_error"].get<double>(), 1e-12);
  EXPECT_THAT(
      ladder_table(farthest_at(parts)),
      HasSubstr("\nwang: the farthest distance goes as epsilon^(0.2941 +- 0.16, 95 %), from 4 subjects "
                "with 3 precisions; at 0.125 to 1 of the claimed distance\n"));
}

// Three points have distances of 16 in x, and the middle one is 1 lower than the others. The sum of squared
// residuals is 2/3, with one degree of freedom.
TEST(Ladder, TheStandardErrorIsThatOfTheSlope) {
  const auto line = fit({{"wang:p24", 1}, {"wang:p40", 0.5}, {"wang:p56", 1}});
  EXPECT_NEAR(line["exponent"], 0.25, 1e-5);
  EXPECT_NEAR(line["standard_error"], std::sqrt(2.0 / 3 / (2 * 16 * 16)), 1e-5);
}

TEST(Ladder, ARatioThatIsKnownFromAboveOnlyIsInNoFit) {
  const auto points = [](double part) {
    return fit({{"wang:p24", 1}, {"wang:p40", 1}, {"wang:p64", 1}, {"wang:p80", part}})["points"];
  };
  EXPECT_EQ(points(1e-16), 4);
  EXPECT_EQ(points(0.9e-16), 3);
}

TEST(Ladder, EachOriginHasAFitOfItsOwn) {
  Statistics statistics = farthest_at({{"wang:p24", 1}, {"wang:p40", 1}, {"wang:p64", 1}});
  const auto families = statistics.counts;
  for (const auto& [key, counts] : families)
    for (const char* search : {"search-far-wang:p24", "search-miss-wang:p40"})
      statistics.counts[{key.subject, key.kind, search}] = counts;
  const auto all = ladder_json(statistics)["fits"];
  ASSERT_EQ(all.size(), 3);
  EXPECT_EQ(all[0]["origin"], "");
  EXPECT_EQ(all[1]["origin"], "directed search");
  EXPECT_EQ(all[2]["origin"], "uniform");
  for (const auto& each : all) {
    EXPECT_NEAR(each["exponent"], 0.25, 1e-5);  // only nearly, because D² also has a term in ε
    EXPECT_EQ(each["precisions"], 3);
  }
}

TEST(Ladder, IsLeftOutWhereThereIsOnePrecision) {
  const Statistics one = farthest_at({{"wang", 1}, {"wang-tight", 1}, {"basic:float", 1}});
  EXPECT_TRUE(ladder_json(one).empty());
  EXPECT_EQ(ladder_table(one), "");
}

}  // namespace
}  // namespace nearmiss
