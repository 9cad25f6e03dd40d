// nearmiss._interface: the functions of the C interface over NumPy arrays. The package's Python code has
// checked the arrays' shapes and types (src/nearmiss/_queries.py).
#include <pthread.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ccd/nearmiss_record.h"
#include "ccd/query/arithmetic.hpp"
#include "oracle/interface/nearmiss.hpp"
#include "tools/python/ending.hpp"

namespace nearmiss::python {
namespace {

namespace py = pybind11;

/// Queries in arrays, which this object keeps alive. `start` and `end` have the same strides. Their shape is
/// (n, vertices of a query, 3); for pairs of a mesh, it is (vertices of the mesh, 3).
class Queries {
 public:
  Queries(int kind, py::array start, py::array end, std::optional<py::array> pairs, py::array separation)
      : start_(std::move(start)),
        end_(std::move(end)),
        pairs_(std::move(pairs)),
        separation_(std::move(separation)) {
    const py::ssize_t vertex_axis = pairs_ ? 0 : 1;
    layout_ = {.kind = kind,
               .type = start_.itemsize() == sizeof(float) ? NEARMISS_FLOAT : NEARMISS_DOUBLE,
               .count = static_cast<std::size_t>(pairs_ ? pairs_->shape(0) : start_.shape(0)),
               .start = start_.data(),
               .end = end_.data(),
               .query_stride = pairs_ ? 0 : start_.strides(0),
               .vertex_stride = start_.strides(vertex_axis),
               .coordinate_stride = start_.strides(vertex_axis + 1),
               .vertices = pairs_ ? static_cast<const std::int32_t*>(pairs_->data()) : nullptr,
               .separation = static_cast<const double*>(separation_.data()),
               .separation_stride = separation_.ndim() == 0 ? 0 : separation_.strides(0)};
  }

  [[nodiscard]] std::size_t size() const { return layout_.count; }

  /// Queries first to first + count - 1.
  [[nodiscard]] nearmiss_queries slice(std::size_t first, std::size_t count) const {
    nearmiss_queries part = layout_;
    const auto steps = static_cast<std::ptrdiff_t>(first);
    part.count = count;
    part.start = static_cast<const std::byte*>(layout_.start) + steps * layout_.query_stride;
    part.end = static_cast<const std::byte*>(layout_.end) + steps * layout_.query_stride;
    if (pairs_) part.vertices = layout_.vertices + nearmiss_vertices(layout_.kind) * steps;
    part.separation = separation_of(first);
    return part;
  }

  /// Why query q has no answer.
  [[nodiscard]] std::string fault(std::size_t q) const {
    const PlainArithmetic guard;
    const double h = *separation_of(q);
    const std::string number = std::to_string(q);
    if (h >= 0 && h < HUGE_VAL) return "query " + number + " has a coordinate that is not finite";
    return "query " + number + " has the separation " + py::str(py::float_(h)).cast<std::string>() +
           ", expected a finite number that is not negative";
  }

 private:
  [[nodiscard]] const double* separation_of(std::size_t q) const {
    return reinterpret_cast<const double*>(reinterpret_cast<const std::byte*>(layout_.separation) +
                                           static_cast<std::ptrdiff_t>(q) * layout_.separation_stride);
  }

  py::array start_, end_;
  std::optional<py::array> pairs_;
  py::array separation_;
  nearmiss_queries layout_;
};

/// Sets plain arithmetic (round to nearest, no flush to zero) for a `with` block of Python, in which NumPy
/// converts numbers.
class PlainBlock {
 public:
  void enter() { guard_.emplace(); }
  void exit() { guard_.reset(); }

 private:
  std::optional<PlainArithmetic> guard_;
};

template <class T>
py::array_t<T> one_for_each(const Queries& queries) {
  return py::array_t<T>(static_cast<py::ssize_t>(queries.size()));
}

/// Divides the queries into parts, and calls ask(part, first) for each part in turn; `first` is the number of
/// the part's first query. Between parts, at most ten times a second, lets Python handle signals. If queries
/// are slow, takes smaller parts, so that signals do not wait long. Stops at the first status other than
/// NEARMISS_OK, and returns this status. Also stops when the interpreter exits.
template <class Ask>
int ask_until_the_end(const Queries& queries, const Ask& ask) {
  using Clock = std::chrono::steady_clock;
  constexpr std::size_t most = 256;
  constexpr std::chrono::milliseconds long_time{10}, between_signals{100};
  auto last = Clock::now();
  std::size_t size = 1;
  for (std::size_t first = 0; first < queries.size() && !must_end();) {
    const auto start = Clock::now();
    const nearmiss_queries part = queries.slice(first, std::min(size, queries.size() - first));
    if (const int status = ask(part, first); status != NEARMISS_OK) return status;
    first += part.count;
    const auto now = Clock::now();
    size = now - start < long_time ? std::min(2 * size, most) : std::max<std::size_t>(size / 8, 1);
    if (now - last < between_signals) continue;
    const py::gil_scoped_acquire none_runs;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    last = Clock::now();
  }
  return NEARMISS_OK;
}

template <class Ask>
int ask_in_parts(const Queries& queries, const Ask& ask) {
  const Running this_call;
  const int status = [&] {
    const py::gil_scoped_release others_run;
    return ask_until_the_end(queries, ask);
  }();
  if (must_end()) end_silently();
  return status;
}

/// Raises the exception for a status. For NEARMISS_NOT_FINITE, the message is about the first query without
/// an answer. This query is in the part that was asked last: all earlier parts are answered.
template <class IsAnswered>
void check(int status, const Queries& queries, const IsAnswered& is_answered) {
  if (status == NEARMISS_OK) return;
  if (status == NEARMISS_OUT_OF_MEMORY) throw std::bad_alloc();
  std::size_t q = 0;
  while (status == NEARMISS_NOT_FINITE && is_answered(q)) ++q;
  throw py::value_error(status == NEARMISS_NOT_FINITE ? queries.fault(q) : nearmiss_message(status));
}

auto has_answer(const std::int8_t* answers) {
  return [answers](std::size_t q) { return answers[q] != NEARMISS_NO_ANSWER; };
}
auto has_answer(const double* numbers) {
  return [numbers](std::size_t q) { return !std::isnan(numbers[q]); };
}

py::tuple collides(const Queries& queries) {
  auto answers = one_for_each<std::int8_t>(queries);
  auto decided_by = one_for_each<std::uint8_t>(queries);
  auto* const to = answers.mutable_data();
  auto* const by = decided_by.mutable_data();
  check(ask_in_parts(queries,
                     [=](const nearmiss_queries& part, std::size_t first) {
                       return nearmiss_collides(&part, to + first, by + first);
                     }),
        queries, has_answer(to));
  return py::make_tuple(answers, decided_by);
}

/// Calls a function of the C interface that gives one answer, a T, for each query.
template <class T, int (*function)(const nearmiss_queries*, T*)>
py::array answers(const Queries& queries) {
  auto answers = one_for_each<T>(queries);
  auto* const to = answers.mutable_data();
  check(ask_in_parts(queries, [=](const nearmiss_queries& part,
                                  std::size_t first) { return function(&part, to + first); }),
        queries, has_answer(to));
  return answers;
}

py::tuple time_of_impact(const Queries& queries, double tmax) {
  auto answers = one_for_each<std::int8_t>(queries);
  auto times = one_for_each<double>(queries);
  auto* const to = answers.mutable_data();
  auto* const toi = times.mutable_data();
  check(ask_in_parts(queries,
                     [=](const nearmiss_queries& part, std::size_t first) {
                       return nearmiss_time_of_impact(&part, tmax, to + first, toi + first);
                     }),
        queries, has_answer(to));
  return py::make_tuple(answers, times);
}

/// Calls a function of the C interface that encloses a time or a distance of each query by two numbers.
template <int (*enclose)(const nearmiss_queries*, double, double*, double*)>
py::tuple enclosures(const Queries& queries, double width) {
  auto lower = one_for_each<double>(queries);
  auto upper = one_for_each<double>(queries);
  auto* const lo = lower.mutable_data();
  auto* const hi = upper.mutable_data();
  check(
      ask_in_parts(queries, [=](const nearmiss_queries& part,
                                std::size_t first) { return enclose(&part, width, lo + first, hi + first); }),
      queries, has_answer(lo));
  return py::make_tuple(lower, upper);
}

/// The certificate of each query; nothing for a query without a certificate.
std::vector<std::optional<std::string>> certificates(const Queries& queries, int what) {
  std::vector<std::optional<std::string>> texts(queries.size());
  std::size_t answered = 0;
  std::string text;
  const int status = ask_in_parts(queries, [&](const nearmiss_queries& part, std::size_t /*first*/) {
    for (std::size_t q = 0; q < part.count; ++q, ++answered) {
      const Status each = certificate(nearmiss::Queries(part), q, text, Prove{what});
      if (each != Status::ok) return static_cast<int>(each);
      if (!text.empty()) texts[answered] = text;
    }
    return NEARMISS_OK;
  });
  check(status, queries, [&](std::size_t q) { return q < answered; });
  return texts;
}

/// Records n queries and what a CCD answered to them. `x` has the shape (n, 6 v), for queries with v
/// vertices; all other arrays have the shape (n,).
void record(int kind, const py::array_t<double, py::array::c_style>& x, const py::array_t<double>& separation,
            const py::array_t<double>& tmax, const py::array_t<int>& answer, const py::array_t<double>& toi,
            bool keep) {
  for (py::ssize_t i = 0; i < x.shape(0); ++i)
    nearmiss_record(kind, x.data(i), separation.at(i), tmax.at(i), answer.at(i), toi.at(i),
                    keep ? NEARMISS_KEEP : 0);
}

}  // namespace
}  // namespace nearmiss::python

PYBIND11_MODULE(_interface, module) {
  using namespace nearmiss::python;
  module.attr("version") = nearmiss_version();
  py::class_<Queries>(module, "Queries")
      .def(py::init<int, py::array, py::array, std::optional<py::array>, py::array>());
  py::class_<PlainBlock>(module, "PlainArithmetic")
      .def(py::init<>())
      .def("__enter__", &PlainBlock::enter)
      .def("__exit__", [](PlainBlock& block, const py::args& /*why*/) { block.exit(); });
  module.def("collides", &collides);
  module.def("earliest_time", &enclosures<nearmiss_earliest_time>);
  module.def("time_of_impact", &time_of_impact);
  module.def("smallest_distance", &enclosures<nearmiss_smallest_distance>);
  module.def("certificates", &certificates);
  module.def("wang", &answers<std::int8_t, nearmiss_wang>);
  module.def("wang_bound", &answers<double, nearmiss_wang_bound>);
  module.def("record", &record);
  module.def("end_calls", &end_calls);
  pthread_atfork(nullptr, nullptr, forget_other_threads);
}
