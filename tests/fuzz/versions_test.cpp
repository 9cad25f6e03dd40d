// Tests the names of subjects, and the comparison of two versions of a CCD, query by query.
#include "fuzz/trial/versions.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <string>
#include <vector>

#include "fuzz/subjects/contracted.hpp"
#include "fuzz/trial/shrunk_finding.hpp"
#include "tests/fuzz/trials.hpp"
#include "tests/plugins.hpp"
#include "tests/refused.hpp"
#include "tests/temporary_folder.hpp"

namespace nearmiss {
namespace {

using ::testing::ElementsAre;
using testing::plugin;

Subjects made_of(const std::vector<std::string>& texts) {
  Subjects made;
  for (const std::string& text : texts)
    for (auto& each : make_any_subjects(text)) made.push_back(std::move(each));
  tell_apart(made);
  return made;
}

std::vector<std::string> names_of(const std::vector<std::string>& texts) {
  std::vector<std::string> names;
  for (const auto& each : made_of(texts)) names.push_back(each->name());
  return names;
}

class SubjectFiles : public testing::TemporaryFolder {
 protected:
  [[nodiscard]] std::string copied(const std::string& name, const std::string& to) const {
    std::filesystem::create_directories(file(to).parent_path());
    std::filesystem::copy(plugin(name), file(to));
    return file(to).string();
  }
};

TEST_F(SubjectFiles, GiveNamesToPluginsThatClash) {
  EXPECT_THAT(names_of({plugin("v1")}), ElementsAre("always"));
  EXPECT_THAT(names_of({plugin("several") + ":edges", "old=" + plugin("v1"), plugin("v2")}),
              ElementsAre("edges", "old", "always"));
  EXPECT_THAT(names_of({copied("v1", "81c6614.so"), plugin("v2"), "wang"}),
              ElementsAre("always-81c6614", "v2", "wang"));
  EXPECT_THAT(names_of({copied("v1", "lib.so.1"), copied("v2", "lib.old.so")}),
              ElementsAre("lib", "lib.old"));
  const std::string other = copied("several", "a.so");
  EXPECT_THAT(names_of({plugin("several") + ":told:answer=1", other + ":told:answer=1"}),
              ElementsAre("several.told:answer=1", "a.told:answer=1"));
  EXPECT_THAT(names_of({plugin("several"), other}), ::testing::IsSupersetOf({"several.told", "a.edges"}));
}

TEST_F(SubjectFiles, WithEqualNamesAreRefusedUnlessTheyAreRenamed) {
  const std::string a = copied("v1", "a/mine.so");
  const std::string b = copied("v2", "b/mine.so");
  EXPECT_ERROR(names_of({a, b}),
               "found two subjects named 'always', expected different names, such as NAME=" + b);
  EXPECT_THAT(names_of({a, "new=" + b}), ElementsAre("always", "new"));
  EXPECT_REFUSED(names_of({a, a}), "two subjects named 'always'");
  EXPECT_REFUSED(names_of({"wang", "wang"}), "such as NAME=wang");
  EXPECT_THAT(names_of({"x=" + a, "y=" + a, "wang", "z=wang@0.5"}), ElementsAre("x", "y", "wang", "z@0.5"));
}

TEST_F(SubjectFiles, DoNotHaveTheNameOfABuiltInSubject) {
  EXPECT_THAT(names_of({plugin("fork")}), ElementsAre("fork"));
  EXPECT_THAT(names_of({copied("fork", "wang.so"), "wang"}), ElementsAre("wang-wang", "wang"));
  EXPECT_REFUSED(names_of({"exact=" + plugin("fork")}),
                 "found the name 'exact', which a built-in subject has, expected another, such as NAME=/");
  EXPECT_REFUSED(names_of({"wang=basic"}), "such as NAME=basic");
}

TEST(SubjectNames, ComeBeforeTheFirstOfColonSlashAndEqualsSign) {
  EXPECT_EQ(SubjectText::parse("a-1.b_C=./v.so:k=1").name, "a-1.b_C");
  for (const char* none : {"./v.so:k=1", "fcl:tolerance=1", "pipe:./p --a=b", "wang", "./a=b/c.so"}) {
    EXPECT_EQ(SubjectText::parse(none).name, "") << none;
    EXPECT_EQ(SubjectText::parse(none).subject, none);
  }
  for (const char* bad : {"=./v.so", "1=./v.so", "a b=wang", "wang@2=wang"})
    EXPECT_REFUSED(SubjectText::parse(bad), "expected NAME=SUBJECT with a name of letters") << bad;
}

TEST(SubjectNames, CanBeGivenToAllSubjects) {
  const std::string program = "new=pipe:" NEARMISS_PYTHON " " NEARMISS_EXAMPLES "/example.py";
  for (const std::string& text : {std::string("new=wang"), std::string("new=defect:mu*0.5"), program})
    EXPECT_EQ(make_any_subject(text)->name(), "new");
  EXPECT_EQ(text_of(*make_any_subject(program)), program);
  EXPECT_EQ(text_of(*make_any_subject("new=wang@0.5")), "new=wang@0.5");
  EXPECT_EQ(make_any_subject("new=wang-eps:h=0.001@0.5")->name(), "new:h=0.001@0.5");
  EXPECT_EQ(make_any_subject("new=" + plugin("several") + ":told:answer=1")->name(), "new:answer=1");
  EXPECT_REFUSED(make_any_subjects("new=" + plugin("several")),
                 "found several detectors, expected one of told");
}

TEST(Predecessors, AreTheFirstSubjectsWhosePluginsExportTheSameName) {
  const Subjects subjects = made_of({plugin("v1"), "wang", plugin("v2"), "basic", "new=" + plugin("v3")});
  EXPECT_THAT(predecessors(subjects, {}),
              ElementsAre(std::nullopt, std::nullopt, std::optional(0UL), std::nullopt, std::optional(0UL)));
  EXPECT_THAT(
      predecessors(subjects, {"basic", "wang"}),
      ElementsAre(std::nullopt, std::optional(3UL), std::optional(0UL), std::nullopt, std::optional(0UL)));
}

/// Collisions, one for each given value of the x coordinate of x0 at t = 0.
Batch batch_at(const std::vector<double>& places, Kind kind = Kind::vertex_triangle) {
  std::vector<Query> queries;
  for (const double x : places)
    queries.push_back(kind == Kind::edge_edge
                          ? testing::moved(testing::falling_edge(1, -1), x + 1)
                          : testing::moved(testing::falling_vertex(0.25, 0.25, 1, -1), x - 0.25));
  return testing::batch_of("f", queries);
}

// v1 reports queries with x > 0, and v2 reports queries with x > 0.25 or x < -0.5. All queries are
// collisions.
TEST(Versions, AreComparedOnTheQueriesThatBothWereAsked) {
  const Subjects subjects = made_of({plugin("v1"), plugin("v2"), plugin("v3"), "wang"});
  const auto result = hold_trial(subjects, batch_at({1, 0.5, 0.125, -0.25, -0.25, -1}));
  const auto& versions = result.statistics.versions;
  EXPECT_THAT(versions, ::testing::SizeIs(2));
  EXPECT_EQ(versions.at({"v1", "v2", Kind::vertex_triangle, "f"}),
            (VersionCounts{.fixed = 1, .broken = 1, .both = 2, .neither = 2}));
  std::vector<std::string> broken;
  for (const Finding& each : result.findings)
    if (!each.broken_since.empty())
      broken.push_back(each.subject + " " + each.broken_since + " " + each.provenance);
  EXPECT_THAT(broken, ElementsAre("v2 v1 2"));
}

TEST(AVersion, AnswersRightlyIfItAnswersAndDoesNotFail) {
  const auto holds = [](const std::string& name, double x) {
    const auto subject = std::move(keep_contract(make_any_subject(plugin(name)), false).front());
    return AnswersRightly(*subject)(batch_at({x}).queries.front());
  };
  EXPECT_TRUE(holds("v1", 0.125));
  EXPECT_FALSE(holds("v1", -1));
  EXPECT_FALSE(holds("error", 0.125));
  EXPECT_FALSE(holds("never_asked", 0.125));
}

TEST(Versions, ThatBreakAQueryBreakTheShrunkOneToo) {
  const Subjects subjects = made_of({plugin("v1"), plugin("v2")});
  Finding finding = hold_trial(subjects, batch_at({0.125})).findings.front();
  ASSERT_EQ(finding.broken_since, "v1");
  FindingShrinker(pointers_to(subjects), Stop::never(), limits_in_campaign).shrink(finding);
  EXPECT_NE(finding.shrunk, finding.query);
  for (const Query& query : {finding.shrunk, finding.simplest}) {
    EXPECT_TRUE(AnswersRightly(*subjects[0])(query));
    EXPECT_FALSE(AnswersRightly(*subjects[1])(query));
  }
}

TEST(FirstFindings, OfAVersionAreKeptApartIfItBreaksThem) {
  FirstFindings first;
  Finding finding;
  finding.subject = "new";
  for (std::size_t i = 0; i < findings_kept; ++i) EXPECT_TRUE(first.take(finding));
  EXPECT_FALSE(first.take(finding));
  finding.broken_since = "old";
  EXPECT_TRUE(first.take(finding));
}

}  // namespace
}  // namespace nearmiss
