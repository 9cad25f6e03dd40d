// Shrinks a finding: searches for the simplest query that fails in the same way.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ccd/query/query.hpp"
#include "ccd/subjects/subject.hpp"
#include "fuzz/stop.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// How much work and time the search for the simplest query may demand of a subject.
struct ShrinkLimits {
  static constexpr std::int64_t of_call = 10;  ///< the work of a call, in addition to the work of its queries
  static constexpr std::int64_t of_process = 1000;  ///< the work of a fault that may end the process

  /// The limit on the work of all queries, calls and ended processes together. The work of a query is 1. The
  /// work does not depend on run times, so this limit ends the search at the same query on every machine.
  std::int64_t work = 1'200'000;
  /// The limit on the time that all answers of the subject take together. Only a slow subject reaches this
  /// limit.
  std::chrono::milliseconds time = std::chrono::minutes(1);
};

/// Limits for a campaign, in which subjects should spend most of their time on cases. Usually, it is the
/// limit on the work that ends a search. The time limit ends a search only if an answer takes more than about
/// 0.1 ms (1 ms if each call asks one query), or if the start of a process takes more than 100 ms.
inline constexpr ShrinkLimits limits_in_campaign{.work = 120'000, .time = std::chrono::seconds(12)};

/// Shrinks findings of some subjects. Many threads may use a FindingShrinker at once.
class FindingShrinker {
 public:
  /// A function that is called now and then, between two calls of the subject. The function may pause the
  /// shrinking by waiting.
  using Rest = std::function<void()>;

  /// The subjects and `stop` must outlive this object.
  FindingShrinker(std::span<const Subject* const> subjects, const Stop& stop, const ShrinkLimits& limits);
  FindingShrinker(const FindingShrinker&) = delete;
  FindingShrinker& operator=(const FindingShrinker&) = delete;
  ~FindingShrinker();

  /// Sets two queries of the finding. `simplest` is the simplest query that fails in the same way. `shrunk`
  /// is the simplest such query that has the finding's class and is no more exotic (exoticness()) than the
  /// finding's query: for example, its vertices may coincide only if vertices of the finding's query do. If
  /// `broken_since` names an earlier version of the CCD, that version answers both queries rightly. The
  /// result depends only on the finding and the subjects, unless the time limit ends a search. A query that
  /// the subject refuses does not count as a failure. If the failure is that the oracle contradicts a
  /// recorded truth, the finding is not shrunk, because the truth is recorded only for the finding's own
  /// query. Throws Stopped, and leaves the finding as it is, at a request to stop, or when Stop::grace has
  /// passed since the time limit.
  void shrink(Finding& finding, const Rest& rest = {}) const;

 private:
  class OfSubject;
  /// The subject of this name; null if no subject has the name.
  [[nodiscard]] const OfSubject* of(const std::string& name) const;

  const Stop& stop_;
  ShrinkLimits limits_;
  std::vector<std::unique_ptr<OfSubject>> of_;
};

/// Returns the simplest query found that fails with the same signature as the finding's query. If the finding
/// has a class, the query is of this class. `subject` may be null for a failure of the oracle. Throws Stopped
/// when `stop` is due.
Query shrunk_query(const Finding& finding, const Subject* subject, const Stop& stop = Stop::never(),
                   const ShrinkLimits& limits = {});

}  // namespace nearmiss
