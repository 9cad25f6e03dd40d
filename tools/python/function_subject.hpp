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

/// Calls function(kind, x, separation) for queries of one kind, with x of shape (n, 2, v, 3), where v is the
/// kind's number of vertices, and separation of shape (n,). The function returns bools (n,); if the subject
/// gives times, it returns times (n,) as well. src/nearmiss/_trials.py checks the answers. Passes on
/// exceptions of the function. The caller must not hold Python's global interpreter lock.
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

/// Queries as an array (n, 2, v, 3), and their separations (n,). All queries must have the v vertices of
/// `kind`.
pybind11::array_t<double> coordinates_of(Kind kind, std::span<const Query> queries);
pybind11::array_t<double> separations_of(std::span<const Query> queries);

}  // namespace nearmiss::python
