#include "tools/timing.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <mutex>
#include <span>

#include "fuzz/parallel.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss::tools {

namespace {

/// Repeats a pass over queries until enough time has passed for timing. Returns the time that passed.
template <class Pass>
std::chrono::duration<double> repeat(const Pass& pass) {
  using std::chrono::steady_clock;
  constexpr auto least = std::chrono::microseconds(500);
  const auto start = steady_clock::now();
  auto now = start;
  for (; now - start < least; now = steady_clock::now()) pass();
  return now - start;
}

/// Times a subject as a trial does, and adds the times per query to `measured`. Adds NaN if the subject
/// answered no query.
void time_once(const Subject& subject, const std::vector<Query>& queries, std::vector<Verdict>& verdicts,
               Measured& measured) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  BatchTime sum;
  if (subject.is_asked(queries.front().kind, any_separation(queries)))
    repeat([&] {
      const BatchTime pass = subject.decide_timed(queries, verdicts);
      sum.queries += pass.queries;
      sum.nanoseconds += pass.nanoseconds;
      sum.kernel_nanoseconds += pass.kernel_nanoseconds;
    });
  const auto per_query = [&](std::uint64_t nanoseconds) {
    return std::max(1.0, static_cast<double>(nanoseconds)) / static_cast<double>(sum.queries);
  };
  measured.times.push_back(sum.queries == 0 ? none : per_query(sum.nanoseconds));
  measured.kernels.push_back(sum.kernel_nanoseconds == 0 ? none : per_query(sum.kernel_nanoseconds));
  measured.throughput.push_back(none);
  if (sum.queries == 0 || plugin_info(subject) == nullptr) return;
  double asked = 0;
  const auto passed = repeat([&] {
    subject.decide(queries, verdicts);
    asked += static_cast<double>(queries.size());
  });
  measured.throughput.back() = asked / passed.count();
}

void count_faults(const std::vector<Verdict>& verdicts, Counts& counts) {
  counts.queries += verdicts.size();
  for (const Verdict& each : verdicts)
    if (each.fault != Fault::none) ++counts.faults[static_cast<std::size_t>(each.fault)];
}

/// Judges a subject's answers, on all processors. Compares each answer with the truth about
/// Subject::rounded() of the query, because the subject decides this rounded query.
Counts judge(const Subject& subject, std::span<const Query> queries, std::span<const Verdict> verdicts,
             const Stop& stop) {
  constexpr std::size_t at_once = 1024;
  std::mutex mutex;
  Counts sum;
  in_parts(queries.size(), [&](std::size_t first, std::size_t last) {
    Counts own;
    std::vector<Query> rounded;
    std::vector<Decision> truths;
    for (std::size_t start = first; start < last; start += at_once) {
      stop.check();
      const std::size_t end = std::min(last, start + at_once);
      rounded.clear();
      for (std::size_t i = start; i < end; ++i) rounded.push_back(subject.rounded(queries[i]));
      truths.resize(rounded.size());
      decide(rounded, truths);
      for (std::size_t i = start; i < end; ++i) {
        const Decision& truth = truths[i - start];
        // If the query is a tie, both answers are right.
        if (verdicts[i].fault != Fault::none || truth.is_tie) continue;
        ++own.queries;
        own.collisions += truth.collision ? 1 : 0;
        own.false_negatives += truth.collision && !verdicts[i].hit ? 1 : 0;
        own.false_positives += !truth.collision && verdicts[i].hit ? 1 : 0;
      }
    }
    const std::lock_guard lock(mutex);
    sum.merge(own);
  });
  return sum;
}

}  // namespace

bool any_separation(const std::vector<Query>& queries) {
  return std::ranges::any_of(queries, [](const Query& query) { return query.separation > 0; });
}

std::vector<Measured> time_all(const Subjects& subjects, const std::vector<Query>& queries, int runs,
                               bool judges, const Stop& stop, Statistics& answered) {
  std::vector<Measured> measured(subjects.size());
  std::vector<Verdict> verdicts(queries.size());
  const Kind kind = queries.front().kind;
  for (int run = 0; run < runs; ++run)
    for (std::size_t s = 0; s < subjects.size(); ++s) {
      stop.check();
      time_once(*subjects[s], queries, verdicts, measured[s]);
      Counts& counts = answered.counts[{subjects[s]->name(), kind, ""}];
      if (!subjects[s]->decides(kind)) continue;
      count_faults(verdicts, counts);
      if (!judges || run + 1 < runs) continue;
      const Counts& judged = measured[s].judged.emplace(judge(*subjects[s], queries, verdicts, stop));
      counts.collisions += judged.collisions;
      counts.false_negatives += judged.false_negatives;
    }
  return measured;
}

}  // namespace nearmiss::tools
