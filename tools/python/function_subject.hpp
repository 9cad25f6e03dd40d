// A Python function as a subject.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "ccd/subjects/described_subject.hpp"

namespace nearmiss::python {

/// A subject that calls function(kind, x, separation) for queries of one kind. x has the shape (n, 2, v, 3),
/// where v is the kind's number of vertices, and separation has the shape (n,). The function returns n bools
/// and, if the subject gives times, n times; src/nearmiss/_trials.py checks the answers. If the
/// function throws an exception, the subject throws it, too. The caller must not hold Python's global
/// interpreter lock.
class FunctionSubject final : public DescribedSubject {
 public:
  FunctionSubject(DetectorInfo info, pybind11::function function)
      : DescribedSubject(std::move(info)), function_(std::move(function)) {}

  using DescribedSubject::decide;
  void decide(std::span<const Query> queries, std::span<Verdict> verdicts) const override;

  [[nodiscard]] BoundAnswer ask_bound(const Query& /*query*/) const override {
    return BoundAnswer::given(HUGE_VAL);  // claims no bound
  }

 private:
  pybind11::function function_;
};

/// The coordinates of n queries, (n, 2, v, 3). All queries must have the v vertices of `kind`.
pybind11::array_t<double> coordinates_of(Kind kind, std::span<const Query> queries);
/// The separations of n queries, (n,).
pybind11::array_t<double> separations_of(std::span<const Query> queries);

}  // namespace nearmiss::python
