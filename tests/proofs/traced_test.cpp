// Tests the recorded operations of a template, and the bounds that Gappa proves for them.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "ccd/wang/cubic.hpp"
#include "ccd/wang/proximity.hpp"
#include "tests/proofs/ccd_problems.hpp"
#include "tests/proofs/gappa.hpp"
#include "tests/proofs/program.hpp"

namespace nearmiss::proofs {
namespace {

TEST(ProofsTraced, MaximaAreNodesAndComparisonsAreRecorded) {
  Trace trace;
  const Vector3<Traced> v(trace.input("x", 1), trace.input("y", -3), trace.input("z", 2));
  EXPECT_EQ(max_component(v).sample(), 3);
  EXPECT_TRUE(trace.branches().empty());
  EXPECT_EQ(std::max(v[0], v[1]).sample(), 1);
  ASSERT_EQ(trace.branches().size(), 1);
  EXPECT_EQ(trace.branches()[0].relation, Branch::Relation::less);
  EXPECT_FALSE(trace.branches()[0].outcome);
  EXPECT_TRUE(Traced(1) < Traced(2));
  EXPECT_EQ(trace.branches().size(), 1);  // constants make no branch
}

// The templates of ccd/ give the same results with recording scalars as with doubles, except that sums of
// three doubles are added in another order if the processor adds two at a time.
TEST(ProofsTraced, EvaluatesAsTheTemplatesDo) {
  Trace trace;
  std::map<std::string, double> inputs;
  Pair<Kind::vertex_triangle, Traced> traced;
  Pair<Kind::vertex_triangle, double> pair;
  int count = 0;
  for (const auto& [to, from] : {std::pair{&traced.p, &pair.p}, {&traced.q, &pair.q}, {&traced.r, &pair.r}}) {
    for (int i = 0; i < 6; ++i) {
      const std::string name(1, static_cast<char>(97 + count++));
      from->xv[i] = inputs[name] = std::sin(1.7 * count);
      to->xv[i] = trace.input(name, 0);
    }
  }
  inputs["time"] = 0.3;
  const Configuration configuration(pair, 0.3);
  const Configuration recorded(traced, trace.input("time", 0));
  Program program;
  for (int i = 0; i < 3; ++i) {
    const int index = program.add(recorded.N[i]);
    const auto results = evaluate<double>(program, inputs, 0x1p-52);
    EXPECT_EQ(results[static_cast<std::size_t>(index)], configuration.N[i]);
  }
}

/// x y + x for x and y in [-1, 1].
Problem product_and_sum() {
  Problem problem;
  problem.trace = std::make_shared<Trace>();
  const Traced x = problem.trace->input("x", 1);
  const Traced y = problem.trace->input("y", 1);
  problem.inputs = {{x, -1, 1, 1}, {y, -1, 1, 1}};
  problem.left = x * y + x;
  return problem;
}

TEST(ProofsGappa, ProvesWhatOneCanCount) {
  Prover prover;
  // The product and the sum have relative errors of u each.
  EXPECT_NEAR(prover.bounds(product_and_sum(), {53}).error * 0x1p53, 3, 1e-6);
  EXPECT_NEAR(prover.bounds(product_and_sum(), {11}).error * 0x1p11, 3, 1e-2);
  EXPECT_TRUE(prover.proves(product_and_sum(), {53}, 3.001 * 0x1p-53));
  EXPECT_FALSE(prover.proves(product_and_sum(), {53}, 2.999 * 0x1p-53));
}

TEST(ProofsGappa, AddsWhatUnderflows) {
  Prover prover;
  EXPECT_NEAR(prover.bounds(product_and_sum(), {53, -60}).error, 3 * 0x1p-53 + 0x1p-60, 1e-23);
}

TEST(ProofsGappa, BoundsAllResults) {
  Prover prover;
  Problem problem = product_and_sum();
  EXPECT_NEAR(prover.bounds(problem, {53}).largest_result, 2, 1e-9);
  problem.left = problem.left * 100;
  EXPECT_NEAR(prover.bounds(problem, {53}).largest_result, 200, 1e-9);
}

TEST(ProofsGappa, KnowsQuotientsAndExtremes) {
  Prover prover;
  Problem problem = product_and_sum();
  const Traced x = problem.inputs[0].expression;
  const Traced y = problem.inputs[1].expression;
  problem.inputs[1].lowest = 0.5;
  problem.left = x / y;
  EXPECT_NEAR(prover.bounds(problem, {53}).error * 0x1p53, 2, 1e-6);
  problem.left = max(abs(x * y), min(x * 3, Traced(1)));
  EXPECT_NEAR(prover.bounds(problem, {53}).error * 0x1p53, 3, 1e-6);
}

TEST(ProofsGappa, TakesNoHintOnTrust) {
  Prover prover;
  EXPECT_THROW(prover.run("{ x in [0, 1] -> x * x in ? }\nx * x -> x;"), std::runtime_error);
  EXPECT_THROW(prover.run("{ x in [0, 1"), std::runtime_error);
}

}  // namespace
}  // namespace nearmiss::proofs
