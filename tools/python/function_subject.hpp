// A Python function as a subject.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "ccd/subjects/detector.hpp"
#include "fuzz/subjects/batch_subject.hpp"

namespace nearmiss::python {

/// Calls function(kind, x, separation) for queries of one kind, with x of shape (n, 2, v, 3), where v is the
/// kind's number of vertices, and separation (n,). The function returns bools (n,), together with times (n,)
/// if the subject gives times (src/nearmiss/_trials.py checks the answers). Its exceptions are passed on. The
/// caller must not hold Python's global interpreter lock.
class FunctionSubject final : public BatchSubject {
 public:
  FunctionSubject(DetectorInfo info, pybind11::function function)
      : BatchSubject(info.name), info_(std::move(info)), function_(std::move(function)) {}

  using BatchSubject::decide;
  void decide(std::span<const Query> queries, std::span<Verdict> verdicts) const override;

  [[nodiscard]] double distance_bound(const Query& /*query*/) const override { return HUGE_VAL; }
  [[nodiscard]] bool claims_bound() const override { return false; }
  [[nodiscard]] bool decides(Kind kind) const override { return nearmiss::decides(info_, kind); }
  [[nodiscard]] bool takes_separation(Kind kind) const override {
    return nearmiss::takes_separation(info_, kind);
  }
  [[nodiscard]] TimeSort time_sort() const override { return info_.time_sort; }

 private:
  DetectorInfo info_;
  pybind11::function function_;
};

/// Queries of kinds with as many vertices v as `kind` as an array (n, 2, v, 3), and their separations (n,).
pybind11::array_t<double> coordinates_of(Kind kind, std::span<const Query> queries);
pybind11::array_t<double> separations_of(std::span<const Query> queries);

}  // namespace nearmiss::python
