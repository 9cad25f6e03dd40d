// Results by class of families: sums, the table on the terminal, report.json and classes.csv.
#include "reports/statistics/family.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "reports/csv.hpp"
#include "reports/json.hpp"
#include "reports/sections/sections.hpp"
#include "reports/text/json.hpp"
#include "tests/reports/campaigns.hpp"

namespace nearmiss {
namespace {

using testing::counts;

TEST(FamilyClass, IsThatOfTheNameWithoutItsParameter) {
  EXPECT_EQ(class_of("uniform"), QueryClass::ordinary);
  EXPECT_EQ(class_of("scene:cloth#3"), QueryClass::ordinary);
  EXPECT_EQ(class_of("sim:cloths"), QueryClass::ordinary);
  for (const char* other : {"sim:cloths@64", "sim:cloths:step=2ms", "sim:cloths~0.1"})
    EXPECT_EQ(class_of(other), QueryClass::unclassified) << other;
  EXPECT_EQ(class_of("grazing"), QueryClass::degenerate);
  EXPECT_EQ(class_of("scale"), QueryClass::extreme);
  EXPECT_EQ(class_of("scale@-1074"), QueryClass::extreme);
}

TEST(FamilyClass, OfVerticesAndEdgesIsThatOfTheirFamily) {
  EXPECT_EQ(class_of("v-scale@3~drawn"), QueryClass::extreme);
  EXPECT_EQ(class_of("v-one-point"), QueryClass::extreme);  // unlike the class of "one-point"
  std::string name;                                         // a forged store may have any name
  for (int i = 0; i < 300'000; ++i) name += "v-";
  EXPECT_EQ(class_of(name + "scale"), QueryClass::unclassified);
}

TEST(FamilyClass, CasesAndSearchesAndUnknownNamesHaveNone) {
  for (const char* name :
       {"cases/", "search-miss-wang", "search-miss", "search-far-wang:p24", "", "uniforms"})
    EXPECT_EQ(class_of(name), QueryClass::unclassified) << name;
}

/// Results of two ordinary families (one of them with late times), of one degenerate family, and of cases.
Statistics some_statistics() {
  Statistics statistics;
  const auto of = [&](const char* family) -> Counts& {
    return statistics.counts[{"mine", Kind::edge_edge, family}];
  };
  of("uniform") = counts(100, 10, 0, 5, 20);
  of("uniform-end") = counts(300, 20, 0, 7, 20);
  of("uniform-end").times_given = of("uniform-end").times_promised = 20;
  of("uniform-end").late = 2;
  of("grazing") = counts(50, 40, 3, 1, 30);
  of("cases/") = counts(8, 8, 1, 0);
  return statistics;
}

TEST(ByClass, TheTerminalShowsARowForEachOfSeveralClasses) {
  EXPECT_THAT(
      summary_table(some_statistics()),
      ::testing::HasSubstr(
          "\nsubject  kind  class         queries  collisions  false neg.  late  false pos.  ns/query\n"
          "mine     ee    ordinary          400          30           0     2          12        20\n"
          "mine     ee    degenerate         50          40           3     -           1        30\n"
          "mine     ee    unclassified        8           8           1     -           0         -\n"));
  Statistics statistics;
  statistics.counts[{"mine", Kind::edge_edge, "uniform"}] = counts(100, 10, 0, 5);
  statistics.counts[{"mine", Kind::edge_edge, "scene:cloth#3"}] = counts(100, 10, 0, 5);
  EXPECT_THAT(summary_table(statistics), ::testing::Not(::testing::HasSubstr("class")));
}

TEST(ByClass, ReportJsonHasTheSumsAndEachFamilysClass) {
  const auto json = summary_json({{}, some_statistics()})["subjects"]["mine"]["ee"];
  EXPECT_EQ(json["classes"].size(), 3);
  EXPECT_EQ(json["classes"]["ordinary"]["queries"], 400);
  EXPECT_EQ(json["classes"]["ordinary"]["false_negative_rate_upper_95"].is_number(), true);
  EXPECT_EQ(json["classes"]["ordinary"]["false_positives"], 12);
  EXPECT_EQ(json["classes"]["degenerate"]["false_negatives"], 3);
  EXPECT_EQ(json["classes"]["degenerate"]["ns_per_query"], 30);
  EXPECT_EQ(json["classes"]["unclassified"]["false_negative_rate_upper_95"], nullptr);
  EXPECT_EQ(json["families"]["uniform-end"]["class"], "ordinary");
  EXPECT_EQ(json["families"]["cases/"]["class"], "unclassified");
}

TEST(ByClass, CsvHasARowForEachClass) {
  const std::string text = classes_csv(some_statistics());
  EXPECT_THAT(text, ::testing::StartsWith("subject,kind,class,queries,collisions,"));
  EXPECT_THAT(text, ::testing::HasSubstr("\nmine,ee,ordinary,400,30,0,0,"));
  EXPECT_THAT(text, ::testing::HasSubstr("\nmine,ee,degenerate,50,40,0,3,"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4);
  EXPECT_THAT(statistics_csv(some_statistics()), ::testing::HasSubstr(",degenerate\n"));
}

}  // namespace
}  // namespace nearmiss
