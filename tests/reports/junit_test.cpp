// A campaign as JUnit's XML and as GitHub's annotations.
#include "reports/junit.hpp"

#include <gmock/gmock.h>

#include "tests/reports/some_campaign.hpp"

namespace nearmiss {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(JUnit, SaysWhatFailedWithItsQuery) {
  const std::string xml = junit_xml(testing::some_campaign("basic"));
  EXPECT_THAT(xml,
              HasSubstr("<testsuite name=\"basic\" tests=\"1\" failures=\"1\" errors=\"0\" skipped=\"0\">"));
  EXPECT_THAT(xml, HasSubstr("<testcase classname=\"nearmiss.basic\" name=\"vt, unclassified families\">"));
  EXPECT_THAT(xml, HasSubstr("<failure message=\"missed 1 of 2 collisions\" type=\"nearmiss\">"));
  EXPECT_THAT(xml, HasSubstr("false-negative, vt simple-root inside in-face; vt query:\n"));
  EXPECT_THAT(junit_xml(testing::some_campaign("basic"), {FailureKind::late}), Not(HasSubstr("<failure")));
}

TEST(JUnit, ASubjectThatWasAskedNothingFails) {
  Campaign campaign;
  campaign.statistics.counts[{"idle", Kind::vertex_triangle, "uniform"}] = {};
  EXPECT_THAT(junit_xml(campaign), HasSubstr("<failure message=\"was asked nothing\" type"));
}

TEST(JUnit, EscapesNames) {
  const std::string xml = junit_xml(testing::some_campaign("<&\">\x01"));
  EXPECT_THAT(xml, HasSubstr("<testsuite name=\"&lt;&amp;&quot;&gt;?\""));
}

TEST(JUnit, HasASuiteForAnOracleThatFails) {
  Campaign campaign = testing::some_campaign("basic");
  EXPECT_THAT(junit_xml(campaign), Not(HasSubstr("testsuite name=\"oracle\"")));
  campaign.statistics.oracle_disagreements = 1;
  EXPECT_THAT(junit_xml(campaign), HasSubstr("<testsuite name=\"oracle\" tests=\"1\" failures=\"1\""));
  EXPECT_THAT(github_annotations(campaign),
              HasSubstr("::error title=nearmiss%3A the oracle::1 ORACLE DISAGREEMENT"));
}

TEST(JUnit, FailuresBeyondAContractDoNotCount) {
  EXPECT_THAT(junit_xml(testing::some_campaign("basic (beyond contract)")), Not(HasSubstr("<failure")));
  EXPECT_EQ(github_annotations(testing::some_campaign("basic (beyond contract)")), "");
}

TEST(GitHub, AnAnnotationIsOneLine) {
  const std::string lines = github_annotations(testing::some_campaign("a:b,100%"));
  EXPECT_THAT(
      lines, HasSubstr("::error title=nearmiss%3A a%3Ab%2C100%25::missed 1 of 2 vt collisions%0Avt query: "));
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 1);
}

}  // namespace
}  // namespace nearmiss
