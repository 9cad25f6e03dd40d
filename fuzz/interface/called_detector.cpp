#include "fuzz/interface/called_detector.hpp"

#include <algorithm>
#include <array>
#include <exception>
#include <limits>
#include <tuple>
#include <vector>

#include "ccd/query/arithmetic.hpp"

namespace nearmiss {

CalledDetector::CalledDetector(const nearmiss_subject& detector, void* state, bool at_once)
    : DescribedSubject(Detector(detector, state).info()), detector_(detector, state), at_once_(at_once) {}

/// The number that `texts_` gives to the text of the current exception.
std::int32_t CalledDetector::number_of_exception() const {
  make_arithmetic_plain();
  try {
    throw;
  } catch (const std::exception& exception) {
    return texts_.number(exception.what());
  } catch (...) {
    return texts_.number("of a type that is not derived from std::exception");
  }
}

std::string CalledDetector::fault_text(const Verdict& verdict) const {
  return verdict.fault == Fault::exception ? texts_.text(verdict.fault_code) : "";
}

/// Asks the detector about queries in one call.
void CalledDetector::ask(std::span<const Query> queries, std::span<Verdict> verdicts) const {
  const Kind kind = queries.front().kind;
  const std::size_t n = queries.size();
  std::vector<double> x(n * coordinate_count(kind));
  std::vector<double> separations(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Query seen = rounded(queries[i]);
    lay_out(info(), seen, i, n, x.data());
    separations[i] = seen.separation;
  }
  std::vector<int> answers(n);
  std::vector<double> times(n);
  {
    std::unique_lock lock(mutex_, std::defer_lock);
    if (!at_once_) lock.lock();
    detector_.decide(kind, x.data(), separations.data(), answers, times);
  }
  for (std::size_t i = 0; i < n; ++i) verdicts[i] = verdict_of(info(), answers[i], times[i]);
}

void CalledDetector::decide(std::span<const Query> queries, std::span<Verdict> verdicts) const {
  for (std::size_t first = 0; first < queries.size(); first += info().batch) {
    const std::size_t n = std::min(info().batch, queries.size() - first);
    const auto some = queries.subspan(first, n);
    const auto answers = verdicts.subspan(first, n);
    try {
      ask(some, answers);
    } catch (...) {
      const Verdict thrown{.fault = Fault::exception, .fault_code = number_of_exception()};
      for (std::size_t i = 0; i < n; ++i) {
        if (n == 1)
          answers[i] = thrown;
        else
          // Asks about the queries one by one, to find those on which the detector throws.
          decide(some.subspan(i, 1), answers.subspan(i, 1));
      }
    }
  }
}

BoundAnswer CalledDetector::ask_bound(const Query& query) const {
  const Query seen = rounded(query);
  std::array<double, std::tuple_size_v<decltype(Query::x)>> x;
  lay_out(info(), seen, 0, 1, x.data());
  std::unique_lock lock(mutex_, std::defer_lock);
  if (!at_once_) lock.lock();
  try {
    return detector_.bound(seen.kind, x.data(), seen.separation);
  } catch (...) {
    return {.fault = Fault::exception, .fault_code = number_of_exception()};
  }
}

}  // namespace nearmiss
