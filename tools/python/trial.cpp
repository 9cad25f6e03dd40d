// nearmiss._trial: trials of Python functions. src/nearmiss/_trials.py turns the results into Python objects.
#include <pthread.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ccd/query/arithmetic.hpp"
#include "ccd/query/error.hpp"
#include "corpus/query_text.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/stop.hpp"
#include "fuzz/subjects/contracted.hpp"
#include "fuzz/subjects/exact.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "fuzz/trial/case_order.hpp"
#include "fuzz/trial/families_asked.hpp"
#include "fuzz/trial/pace.hpp"
#include "fuzz/trial/shrunk_finding.hpp"
#include "fuzz/trial/so_far.hpp"
#include "fuzz/trial/trial.hpp"
#include "oracle/explanation.hpp"
#include "tools/python/ending.hpp"
#include "tools/python/function_subject.hpp"

namespace nearmiss::python {
namespace {

namespace py = pybind11;

/// The subject for an object of the Python class Subject.
std::unique_ptr<Subject> function_of(const py::object& each) {
  DetectorInfo info;
  info.name = each.attr("name").cast<std::string>();
  if (const std::string fault = fault_of_name(info.name); !fault.empty()) throw Error("found " + fault);
  info.time_sort = static_cast<TimeSort>(each.attr("_number_of_time_sort")().cast<int>());
  for (const Kind kind : kinds)
    if (each.attr("kinds").contains(short_name(kind))) info.kinds |= bit_of(kind);
  if (each.attr("takes_separation").cast<bool>()) info.separation_kinds = info.kinds;
  return std::make_unique<FunctionSubject>(std::move(info), each.attr("_decide").cast<py::function>());
}

/// The subjects for a list. Each item is an object of the Python class Subject, or a text as `nearmiss fuzz
/// --subject` takes it.
Subjects subjects_of(const py::list& of, const Stop& stop) {
  isolation::PluginLimits limits;
  limits.most_late = most_slow;
  limits.stop = &stop;
  Subjects made;
  for (const auto& each : of) {
    if (!py::isinstance<py::str>(each)) {
      made.push_back(function_of(py::reinterpret_borrow<py::object>(each)));
      continue;
    }
    const auto text = each.cast<std::string>();
    const py::gil_scoped_release others_run;
    for (auto& subject : make_any_subjects(text, std::nullopt, limits)) made.push_back(std::move(subject));
  }
  tell_apart(made);
  Subjects subjects;
  for (auto& subject : made)
    for (auto& kept : keep_contract(std::move(subject), false)) subjects.push_back(std::move(kept));
  return subjects;
}

/// The kinds of queries that a trial asks if the caller names no families. If some subjects are functions,
/// these are all kinds that at least one function decides. Otherwise, these are the kinds that a campaign
/// with these subjects asks.
std::vector<Kind> kinds_of(const Subjects& subjects) {
  const auto is_function = [](const auto& each) {
    return dynamic_cast<const FunctionSubject*>(each.get()) != nullptr;
  };
  std::vector<Kind> asked = kinds_to_ask(subjects, [](Kind kind) { return !is_of_meshes(kind); });
  if (std::ranges::any_of(subjects, is_function))
    std::erase_if(asked, [&](Kind kind) {
      return std::ranges::none_of(subjects,
                                  [&](const auto& each) { return is_function(each) && each->decides(kind); });
    });
  return asked;
}

/// The families that the caller names. If the caller names none, returns all families of the kinds that the
/// trial asks.
std::vector<Family> families_of(const std::vector<std::string>& names, const Subjects& subjects) {
  if (names.empty()) return families_asked({}, kinds_of(subjects));
  return families_asked(names, kinds);
}

void let_python_handle_signals() {
  const py::gil_scoped_acquire lock;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

/// A function that receives the number of decided cases and the number of misses so far.
using Report = std::function<void(std::uint64_t cases, std::uint64_t missed)>;

/// For each subject, what earlier cases of the batch's kind and family show about the subject.
std::vector<Known> known_before(const Batch& batch, const Subjects& subjects, const SoFar& so_far) {
  std::vector<Known> known;
  for (const auto& subject : subjects)
    known.push_back(so_far.of(CountsKey{subject->name(), batch.kind, batch.family}));
  return known;
}

/// Asks the subjects the queries of a campaign's plan, in the plan's order.
TrialResult decide_all(const CampaignPlan& plan, const Subjects& subjects, const Stop& stop,
                       const Report& report) {
  TrialResult result;
  CasesOfShard cases(plan, 0);
  Pace pace;
  SoFar so_far;
  std::uint64_t decided = 0;
  while (const auto block = cases.next(pace)) {
    const auto start = Stop::Clock::now();
    for (const Kind kind : kinds_asked(*block->family)) {
      Batch batch = batch_of(plan, *block, kind, stop);
      if (batch.queries.empty()) continue;
      batch.timed = false;
      TrialResult of_batch =
          hold_trial(subjects, batch, plan.comparison, known_before(batch, subjects, so_far));
      so_far.take(of_batch.statistics.counts);
      result.merge(std::move(of_batch));
    }
    decided += block->cases();
    report(decided, result.statistics.false_negatives());
    pace.took(block->family->name, block->cases(), Stop::Clock::now() - start);
    let_python_handle_signals();
    stop.check();
  }
  return result;
}

/// For each signature (a way to fail) and each class of queries, shrinks the first `of_each` findings.
void shrink(std::vector<Finding>& findings, const Subjects& subjects, std::uint64_t of_each,
            const Stop& stop) {
  const FindingShrinker shrinker(pointers_to(subjects), stop, limits_in_campaign);
  std::map<std::pair<Signature, QueryClass>, std::uint64_t> seen;
  for (Finding& finding : findings) {
    if (++seen[{signature_of(finding), finding.query_class}] > of_each) continue;
    shrinker.shrink(finding);
    let_python_handle_signals();
  }
}

/// The largest ratio of a false positive's distance to the bound on this distance. If the bound is 0,
/// `counts` has the largest double as the ratio, and this function returns infinity.
double farthest(const Counts& counts) {
  const double ratio = counts.max_ratio();
  return ratio == std::numeric_limits<double>::max() ? std::numeric_limits<double>::infinity() : ratio;
}

py::list counts_of(const Statistics& statistics) {
  py::list rows;
  for (const auto& [key, counts] : statistics.counts)
    rows.append(py::make_tuple(key.subject, short_name(key.kind), key.family, counts.queries,
                               counts.collisions, counts.false_negatives, counts.false_positives, counts.late,
                               counts.committed,
                               counts.faults_total() - counts.without_answer(Fault::contract),
                               counts.without_answer(Fault::contract), farthest(counts)));
  return rows;
}

template <class Of>
py::list column(const std::vector<Finding>& findings, const Of& of) {
  py::list values;
  for (const Finding& finding : findings) values.append(of(finding));
  return values;
}

std::vector<Query> queries_of(const std::vector<Finding>& findings, Query Finding::*member) {
  std::vector<Query> queries;
  for (const Finding& finding : findings) queries.push_back(finding.*member);
  return queries;
}

py::dict columns(const std::vector<Finding>& findings) {
  const std::vector<Query> found = queries_of(findings, &Finding::query);
  const std::vector<Query> shrunk = queries_of(findings, &Finding::shrunk);
  py::dict of;
  of["x"] = coordinates_of(Kind::vertex_triangle, found);
  of["separation"] = separations_of(found);
  of["shrunk"] = coordinates_of(Kind::vertex_triangle, shrunk);
  of["shrunk_separation"] = separations_of(shrunk);
  py::array_t<bool> is_shrunk(static_cast<py::ssize_t>(findings.size()));
  std::transform(findings.begin(), findings.end(), is_shrunk.mutable_data(),
                 [](const Finding& each) { return each.is_shrunk; });
  of["is_shrunk"] = is_shrunk;
  of["kind"] = column(findings, [](const Finding& each) { return short_name(each.query.kind); });
  of["class_"] = column(findings, [](const Finding& each) { return name(each.query_class); });
  of["what"] = column(findings, [](const Finding& each) { return name(each.what); });
  of["subject"] = column(findings, [](const Finding& each) { return each.subject; });
  of["family"] = column(findings, [](const Finding& each) { return each.family; });
  of["signature"] = column(findings, [](const Finding& each) { return each.signature; });
  of["provenance"] = column(findings, [](const Finding& each) { return each.provenance; });
  return of;
}

Report report_to(const py::object& function) {
  if (function.is_none()) return [](std::uint64_t /*cases*/, std::uint64_t /*missed*/) {};
  return [&function](std::uint64_t cases, std::uint64_t missed) {
    const py::gil_scoped_acquire lock;
    function(cases, missed);
    make_arithmetic_plain();
  };
}

py::tuple hold(const py::list& of_subjects, const std::vector<std::string>& families, std::uint64_t cases,
               std::uint64_t seed, std::uint64_t shrunk_of_each, const py::object& progress) {
  const PlainArithmetic guard;
  const Stop stop(ending());
  const Subjects subjects = subjects_of(of_subjects, stop);
  CampaignPlan plan;
  plan.families = families_of(families, subjects);
  expect_all_asked(subjects, plan.families);
  plan.seed = seed;
  plan.cases = cases;
  TrialResult result;
  try {
    const Running this_one;
    const py::gil_scoped_release others_run;
    result = decide_all(plan, subjects, stop, report_to(progress));
    std::erase_if(result.findings, [](const Finding& each) { return is_only_shown(each.what); });
    shrink(result.findings, subjects, shrunk_of_each, stop);
  } catch (const Stopped&) {
    end_silently();  // here, Stopped is thrown only when the interpreter exits
  }
  return py::make_tuple(counts_of(result.statistics), columns(result.findings));
}

std::vector<std::pair<std::string, std::string>> known_families() {
  std::vector<std::pair<std::string, std::string>> known;
  for (const Family& family : all_families()) known.emplace_back(family.name, family.about);
  return known;
}

py::tuple make(const std::string& family, const std::string& kind_name, std::size_t count,
               std::uint64_t seed) {
  const PlainArithmetic guard;
  std::vector<Query> queries;
  if (count > queries.max_size()) throw std::bad_alloc();
  queries.reserve(count);
  const Family from = find_family(family);
  const Kind kind = parse_kind(kind_name, "kind");
  expect_kind(from, kind, "kind");
  const QueryMaker query(from, seed);
  for (std::uint64_t index = 0; queries.size() < count; ++index) {
    if (kind_of(from, index) == kind) queries.push_back(query(index));
    if (index % 1000 == 0) let_python_handle_signals();
  }
  return py::make_tuple(coordinates_of(kind, queries), separations_of(queries));
}

std::string explanation(const std::string& kind_name, const py::array_t<double, py::array::c_style>& x,
                        double separation) {
  const PlainArithmetic guard;
  const Kind kind = parse_kind(kind_name, "kind");
  if (static_cast<std::size_t>(x.size()) != coordinate_count(kind))
    throw Error("x: found " + std::to_string(x.size()) + " coordinates, expected " +
                std::to_string(coordinate_count(kind)));
  return to_text(explain(with_separation(query_of(kind, x.data()), separation)));
}

}  // namespace
}  // namespace nearmiss::python

PYBIND11_MODULE(_trial, module) {
  using namespace nearmiss::python;
  pybind11::register_local_exception<nearmiss::Error>(module, "Error", PyExc_ValueError);
  module.def("hold", &hold);
  module.def("families", &known_families);
  module.def("queries", &make);
  module.def("explanation", &explanation);
  module.def("end_calls", &end_calls);
  pthread_atfork(nullptr, nullptr, forget_other_threads);
}
