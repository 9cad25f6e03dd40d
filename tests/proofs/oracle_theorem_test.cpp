// Tests that the error bounds of the oracle's filter are at least the errors, for all leaves, sizes and
// times.
#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <set>
#include <string>

#include "tests/proofs/gappa_process.hpp"
#include "tests/proofs/oracle_results.hpp"

namespace nearmiss::proofs {
namespace {

/// Adds the scripts that prove the error bounds of all results of some templates. Each bound is multiplied by
/// `factor` first.
template <class Real>
void add_scripts(std::set<std::string>& scripts, Leaves leaves, std::initializer_list<Results> all,
                 double factor = 1) {
  for (const Results results : all) {
    Trace trace;
    for (Bounded each : results(trace, leaves)) {
      if (factor != 1) each.error = each.error * factor;
      scripts.merge(scripts_of(each, precision_of<Real>()));
    }
  }
}

TEST(ProofsOfTheFilter, BoundWeightsCoplanarityAndPartsInDoubleAndDoubleWords) {
  std::set<std::string> scripts;
  for (const Leaves leaves : {Leaves::rounded_once, Leaves::given_errors})
    add_scripts<Traced>(scripts, leaves,
                        {weight_results<Traced>, cubic_results<Traced>, part_results<Traced>});
  add_scripts<TracedWord>(scripts, Leaves::given_errors,
                          {weight_results<TracedWord>, cubic_results<TracedWord>, part_results<TracedWord>});
  for (const std::string& script : scripts) EXPECT_TRUE(is_proven(script)) << script;
}

TEST(ProofsOfTheFilter, FailWhereABoundIsSmaller) {
  const auto is_proven_with = [](Leaves leaves, Results results, double factor) {
    std::set<std::string> scripts;
    add_scripts<Traced>(scripts, leaves, {results}, factor);
    return std::all_of(scripts.begin(), scripts.end(), is_proven);
  };
  EXPECT_FALSE(is_proven_with(Leaves::rounded_once, weight_results<Traced>, 0.75));
  EXPECT_FALSE(is_proven_with(Leaves::given_errors, weight_results<Traced>, 0.75));
  EXPECT_FALSE(is_proven_with(Leaves::given_errors, part_results<Traced>, 0.7));
}

}  // namespace
}  // namespace nearmiss::proofs
