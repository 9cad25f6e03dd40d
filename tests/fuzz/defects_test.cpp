// Each defect is the real code with one change.
#include "fuzz/subjects/defects.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "fuzz/families/families.hpp"
#include "oracle/oracle.hpp"
#include "tests/queries.hpp"
#include "tests/refused.hpp"

namespace nearmiss {
namespace {

template <class Check>
void for_all_families(std::uint64_t each, const Check& check) {
  for (const Family& family : families())
    for (std::uint64_t i = 0; i < each; ++i) check(make_query(family, 7, i));
}

TEST(Defects, AreAtLeastThirtyWithNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const Defect& defect : defects()) {
    names.insert(defect.name);
    EXPECT_EQ(try_make_defect(defect.name)->name(), defect.name);
    EXPECT_FALSE(defect.about.empty());
  }
  EXPECT_EQ(names.size(), defects().size());
  EXPECT_GE(names.size(), 30U);
}

TEST(Defects, DecideAsWangDoesWhereNothingIsWrong) {
  const auto wang = make_subject("wang");
  const auto same = try_make_defect("defect:mu*1");
  for_all_families(300, [&](const Query& query) {
    const Verdict expected = wang->decide(query);
    const Verdict verdict = same->decide(query);
    ASSERT_EQ(verdict.hit, expected.hit);
    ASSERT_EQ(verdict.stage, expected.stage);
    if (expected.hit) {
      ASSERT_EQ(verdict.time, expected.time);
    }
    ASSERT_EQ(same->distance_bound(query), wang->distance_bound(query));
  });
}

/// Whether a defect gives another answer or time than the sound subject for some query of `uniform` or
/// `uniform~drawn`.
bool is_different(const std::string& defect, const std::string& sound) {
  const auto defective = try_make_defect("defect:" + defect);
  const auto subject = make_subject(sound);
  for (const char* family : {"uniform", "uniform~drawn"})
    for (std::uint64_t i = 0; i < 3000; ++i) {
      const Query query = make_query(find_family(family), 7, i);
      const Verdict verdict = defective->decide(query);
      const Verdict expected = subject->decide(query);
      if (verdict.hit != expected.hit || (verdict.hit && verdict.time != expected.time)) return true;
    }
  return false;
}

TEST(Defects, OfTimesChangeSomeAnswers) {
  for (const char* defect :
       {"later-root", "upper-end", "middle", "time-rounding", "time-vertex", "time-float"})
    EXPECT_TRUE(is_different(defect, "wang-time")) << defect;
  for (const char* defect : {"step-rounding", "step-vertex", "rest-of-step", "lines", "boxes-at-start",
                             "contact", "float-separation"})
    EXPECT_TRUE(is_different(defect, "advance")) << defect;
}

TEST(Defects, MultiplyTheirOwnTolerance) {
  // A vertex that passes the triangle's corner at half the largest distance that VV accepts.
  Query query = testing::falling_vertex(0, 0, 0, 0);
  const Vector3<double> velocity(2, -1, 0);
  const auto pass = [&](double distance) {
    const Vector3<double> closest = distance * Vector3<double>(-1, -2, 0).normalized();
    query.set_start(0, closest - velocity / 2);
    query.set_end(0, closest + velocity / 2);
  };
  pass(0);
  pass(make_subject("wang")->distance_bound(query) / 2);
  EXPECT_EQ(make_subject("wang")->decide(query).stage, Stage::vv);
  EXPECT_TRUE(try_make_defect("defect:D2*0.5")->decide(query).hit);
  EXPECT_FALSE(try_make_defect("defect:D2*0.1")->decide(query).hit);
  EXPECT_FALSE(try_make_defect("defect:vv")->decide(query).hit);
  EXPECT_NEAR(make_subject("wang")->needed_tolerance(query), 0.5, 0.02);
  EXPECT_NEAR(try_make_defect("defect:ties")->needed_tolerance(query), 0.5, 0.02);
  EXPECT_NEAR(try_make_defect("defect:D2*0.0625")->needed_tolerance(query), 4, 0.08);
}

TEST(Defects, AreRefusedWhereUnknown) {
  EXPECT_EQ(try_make_defect("wang"), nullptr);
  EXPECT_REFUSED(try_make_defect("defect:nothing"), "'defect:nothing'");
  EXPECT_REFUSED(try_make_defect("defect:nu*2"), "'defect:nu*2'");
  EXPECT_REFUSED(try_make_defect("defect:mu*-1"), "0 or more");
  EXPECT_REFUSED(try_make_defect("defect:mu*x"), "finite number");
}

TEST(NeededTolerance, IsAtMostOneForHitsAlone) {
  const auto wang = make_subject("wang");
  for_all_families(100, [&](const Query& query) {
    ASSERT_EQ(wang->needed_tolerance(query) <= 1, wang->decide(query).hit);
  });
}

}  // namespace
}  // namespace nearmiss
