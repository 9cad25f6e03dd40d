// Runs the function templates with which the oracle's filter computes F, the coplanarity cubic, and the
// weights, with scalars that record every operation (traced.hpp).
#pragma once

#include <string>
#include <vector>

#include "tests/proofs/oracle_theorem.hpp"

namespace nearmiss::proofs {

/// A function that traces one of the templates below, and returns the results with their bounds.
using Results = std::vector<Bounded> (*)(Trace&, Leaves);

/// Returns three results of a polynomial, each with its bound: the coefficients, the coefficients of the same
/// polynomial on the interval [t, s], and the value at t.
template <class Real, std::size_t n>
std::vector<Bounded> results_of(Trace& trace, const certified::Bernstein<Real, n>& polynomial,
                                Leaves leaves) {
  const Traced t = trace.input("t", 0.25);
  const Traced s = trace.input("s", 0.75);
  std::vector<Bounded> all;
  const auto add = [&](const Traced& value) { all.push_back({value, polynomial.error, leaves, {"t", "s"}}); };
  for (const Real& each : polynomial.b) add(approximate(each));
  for (const Real& each : polynomial.on(t, s)) add(approximate(each));
  add(polynomial.at(t));
  return all;
}

/// Component x of b × c: a weight.
template <class Real>
std::vector<Bounded> weight_results(Trace& trace, Leaves leaves) {
  return results_of(trace,
                    certified::cross_component(traced_motion<Real>(trace, 'b', leaves),
                                               traced_motion<Real>(trace, 'c', leaves), 0),
                    leaves);
}

/// The coplanarity cubic F.
template <class Real>
std::vector<Bounded> cubic_results(Trace& trace, Leaves leaves) {
  return results_of(
      trace,
      certified::coplanarity(traced_motion<Real>(trace, 'a', leaves), traced_motion<Real>(trace, 'b', leaves),
                             traced_motion<Real>(trace, 'c', leaves)),
      leaves);
}

/// Component x of a vector at both ends of the part [t, s] of the step.
template <class Real>
std::vector<Bounded> part_results(Trace& trace, Leaves leaves) {
  const Traced t = trace.input("t", 0.25);
  const Traced s = trace.input("s", 0.75);
  const auto motion = certified::part_of(traced_motion<Real>(trace, 'a', leaves), t, s);
  return {{approximate(motion.start[0]), motion.error[0], leaves, {"t", "s"}},
          {approximate(motion.end[0]), motion.error[0], leaves, {"t", "s"}}};
}

}  // namespace nearmiss::proofs
