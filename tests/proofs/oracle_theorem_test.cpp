// The error bounds of the oracle's filter dominate the errors: for all leaves, sizes and times.
#include <gtest/gtest.h>

#include "tests/proofs/gappa_process.hpp"
#include "tests/proofs/oracle_theorem.hpp"

namespace nearmiss::proofs {
namespace {

using certified::Bernstein;

/// The coefficients, those on [t, s], and the value at t of a polynomial, each with its bound.
template <class Real, std::size_t n>
std::vector<Bounded> results(Trace& trace, const Bernstein<Real, n>& polynomial, Leaves leaves) {
  const Traced t = trace.input("t", 0.25);
  const Traced s = trace.input("s", 0.75);
  std::vector<Bounded> all;
  const auto add = [&](const Real& value) {
    all.push_back({approximate(value), polynomial.error, leaves, {"t", "s"}});
  };
  for (const Real& each : polynomial.b) add(each);
  for (const Real& each : polynomial.on(t, s)) add(each);
  all.push_back({polynomial.at(t), polynomial.error, leaves, {"t", "s"}});
  return all;
}

template <class Real>
std::vector<Bounded> weight(Trace& trace, Leaves leaves) {
  return results(trace,
                 certified::cross_component(traced_motion<Real>(trace, 'b', leaves),
                                            traced_motion<Real>(trace, 'c', leaves), 0),
                 leaves);
}

template <class Real>
std::vector<Bounded> cubic(Trace& trace, Leaves leaves) {
  return results(
      trace,
      certified::coplanarity(traced_motion<Real>(trace, 'a', leaves), traced_motion<Real>(trace, 'b', leaves),
                             traced_motion<Real>(trace, 'c', leaves)),
      leaves);
}

/// The components of a vector at the ends of a part of the step.
template <class Real>
std::vector<Bounded> part(Trace& trace, Leaves leaves) {
  const Traced t = trace.input("t", 0.25);
  const Traced s = trace.input("s", 0.75);
  const auto motion = certified::part_of(traced_motion<Real>(trace, 'a', leaves), t, s);
  return {{approximate(motion.start[0]), motion.error[0], leaves, {"t", "s"}},
          {approximate(motion.end[0]), motion.error[0], leaves, {"t", "s"}}};
}

template <class Real>
void expect_proven(const std::vector<Bounded>& all) {
  for (const Bounded& each : all)
    for (const std::string& script : scripts_of(each, precision_of<Real>()))
      EXPECT_TRUE(is_proven(script)) << script;
}

TEST(ProofsOfTheFilter, WeightsInDouble) {
  Trace trace;
  expect_proven<Traced>(weight<Traced>(trace, Leaves::rounded_once));
}
TEST(ProofsOfTheFilter, WeightsOfPartsInDouble) {
  Trace trace;
  expect_proven<Traced>(weight<Traced>(trace, Leaves::given_errors));
}
TEST(ProofsOfTheFilter, WeightsInDoubleWords) {
  Trace trace;
  expect_proven<TracedWord>(weight<TracedWord>(trace, Leaves::given_errors));
}
TEST(ProofsOfTheFilter, CoplanarityInDouble) {
  Trace trace;
  expect_proven<Traced>(cubic<Traced>(trace, Leaves::rounded_once));
}
TEST(ProofsOfTheFilter, CoplanarityOfPartsInDouble) {
  Trace trace;
  expect_proven<Traced>(cubic<Traced>(trace, Leaves::given_errors));
}
TEST(ProofsOfTheFilter, CoplanarityInDoubleWords) {
  Trace trace;
  expect_proven<TracedWord>(cubic<TracedWord>(trace, Leaves::given_errors));
}
TEST(ProofsOfTheFilter, PartsOfTheStep) {
  Trace trace;
  expect_proven<Traced>(part<Traced>(trace, Leaves::rounded_once));
  expect_proven<Traced>(part<Traced>(trace, Leaves::given_errors));
  expect_proven<TracedWord>(part<TracedWord>(trace, Leaves::given_errors));
}

}  // namespace
}  // namespace nearmiss::proofs
