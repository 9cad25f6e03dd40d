#include "tools/python/function_subject.hpp"

#include <algorithm>
#include <cstddef>

#include "ccd/query/arithmetic.hpp"

namespace nearmiss::python {

namespace py = pybind11;

py::array_t<double> coordinates_of(Kind kind, std::span<const Query> queries) {
  py::array_t<double> x({static_cast<py::ssize_t>(queries.size()), py::ssize_t{2},
                         static_cast<py::ssize_t>(vertices(kind)), py::ssize_t{3}});
  double* to = x.mutable_data();
  for (const Query& query : queries) {
    copy_coordinates(kind, query.x.data(), to);
    to += coordinate_count(kind);
  }
  return x;
}

py::array_t<double> separations_of(std::span<const Query> queries) {
  py::array_t<double> separations(static_cast<py::ssize_t>(queries.size()));
  std::transform(queries.begin(), queries.end(), separations.mutable_data(),
                 [](const Query& query) { return query.separation; });
  return separations;
}

void FunctionSubject::decide(std::span<const Query> queries, std::span<Verdict> verdicts) const {
  if (queries.empty()) return;
  const py::gil_scoped_acquire lock;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  const py::tuple answer = function_(short_name(queries.front().kind),
                                     coordinates_of(queries.front().kind, queries), separations_of(queries));
  make_arithmetic_plain();
  const auto hits = answer[0].cast<py::array_t<bool>>();
  const auto times = answer[1].cast<py::array_t<double>>();
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const auto at = static_cast<py::ssize_t>(i);
    verdicts[i] = verdict_of(info(), hits.at(at) ? NEARMISS_COLLISION : NEARMISS_NO_COLLISION, times.at(at));
  }
}

}  // namespace nearmiss::python
