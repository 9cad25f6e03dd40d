// The error bounds of the oracle's filter are at least the errors, for all leaves, sizes and times.
#include <gtest/gtest.h>

#include "tests/proofs/gappa_process.hpp"
#include "tests/proofs/oracle_results.hpp"

namespace nearmiss::proofs {
namespace {

template <class Real>
void expect_proven(const std::vector<Bounded>& all) {
  for (const Bounded& each : all)
    for (const std::string& script : scripts_of(each, precision_of<Real>()))
      EXPECT_TRUE(is_proven(script)) << script;
}

TEST(ProofsOfTheFilter, WeightsInDouble) {
  Trace trace;
  expect_proven<Traced>(weight_results<Traced>(trace, Leaves::rounded_once));
}
TEST(ProofsOfTheFilter, WeightsOfPartsInDouble) {
  Trace trace;
  expect_proven<Traced>(weight_results<Traced>(trace, Leaves::given_errors));
}
TEST(ProofsOfTheFilter, WeightsInDoubleWords) {
  Trace trace;
  expect_proven<TracedWord>(weight_results<TracedWord>(trace, Leaves::given_errors));
}
TEST(ProofsOfTheFilter, CoplanarityInDouble) {
  Trace trace;
  expect_proven<Traced>(cubic_results<Traced>(trace, Leaves::rounded_once));
}
TEST(ProofsOfTheFilter, CoplanarityOfPartsInDouble) {
  Trace trace;
  expect_proven<Traced>(cubic_results<Traced>(trace, Leaves::given_errors));
}
TEST(ProofsOfTheFilter, CoplanarityInDoubleWords) {
  Trace trace;
  expect_proven<TracedWord>(cubic_results<TracedWord>(trace, Leaves::given_errors));
}
TEST(ProofsOfTheFilter, PartsOfTheStep) {
  Trace trace;
  expect_proven<Traced>(part_results<Traced>(trace, Leaves::rounded_once));
  expect_proven<Traced>(part_results<Traced>(trace, Leaves::given_errors));
  expect_proven<TracedWord>(part_results<TracedWord>(trace, Leaves::given_errors));
}

/// Whether all scripts of all results are proven if each bound is multiplied by `factor`.
bool is_proven_with(const std::vector<Bounded>& all, double factor) {
  for (Bounded each : all) {
    each.error = each.error * factor;
    for (const std::string& script : scripts_of(each, precision_of<Traced>()))
      if (!is_proven(script)) return false;
  }
  return true;
}

TEST(ProofsOfTheFilter, FailWhereABoundIsSmaller) {
  Trace trace;
  EXPECT_TRUE(is_proven_with(weight_results<Traced>(trace, Leaves::rounded_once), 1));
  EXPECT_FALSE(is_proven_with(weight_results<Traced>(trace, Leaves::rounded_once), 0.75));
  EXPECT_FALSE(is_proven_with(weight_results<Traced>(trace, Leaves::given_errors), 0.75));
  EXPECT_FALSE(is_proven_with(part_results<Traced>(trace, Leaves::given_errors), 0.7));
}

}  // namespace
}  // namespace nearmiss::proofs
