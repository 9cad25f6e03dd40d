#include "fuzz/trial/shrunk_finding.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <span>

#include "ccd/error.hpp"
#include "fuzz/subjects/forwarding_subject.hpp"
#include "fuzz/subjects/isolation/plugin_file.hpp"
#include "fuzz/trial/judge.hpp"
#include "fuzz/trial/shrink.hpp"
#include "fuzz/trial/signatures.hpp"
#include "fuzz/trial/small_queries.hpp"

namespace nearmiss {

namespace {

/// What was found in the last moment of a campaign's time is still shrunk.
constexpr std::chrono::milliseconds grace{1000};

using Clock = std::chrono::steady_clock;

/// Whether a new process may be needed after a fault.
bool ends_process(const Verdict& verdict) {
  switch (verdict.fault) {
    case Fault::crash:
    case Fault::time:
    case Fault::memory:
    case Fault::exception:
    case Fault::protocol:
    case Fault::load:
      return true;
    default:
      return false;
  }
}

/// A subject that refuses further queries when a limit is reached.
class Limited final : public ForwardingSubject {
  /// The subject's answer, which costs the work of this number of queries. Throws Error if a limit is reached.
  template <class Ask>
  auto asked(std::size_t queries, const Ask& ask) const {
    if (work_ <= 0) throw Error("the subject has answered as many queries as it may");
    if (time_ <= Clock::duration::zero()) throw Error("the subject has answered as long as it may");
    work_ -= ShrinkLimits::of_call + static_cast<std::int64_t>(queries);
    const auto before = Clock::now();
    auto answer = ask();
    time_ -= Clock::now() - before;
    return answer;
  }

 public:
  Limited(const Subject& to, std::int64_t work, Clock::duration time)
      : ForwardingSubject(to.name(), to), work_(work), time_(time) {}

  using ForwardingSubject::decide;
  void decide(std::span<const Query> queries, std::span<Verdict> verdicts) const override {
    asked(queries.size(), [&] {
      to().decide(queries, verdicts);
      return true;
    });
    work_ -= ShrinkLimits::of_process * std::count_if(verdicts.begin(), verdicts.end(), ends_process);
  }
  [[nodiscard]] double distance_bound(const Query& query) const override {
    return asked(1, [&] { return to().distance_bound(query); });
  }
  [[nodiscard]] BoundAnswer ask_bound(const Query& query) const override {
    return asked(1, [&] { return to().ask_bound(query); });
  }

 private:
  mutable std::int64_t work_;
  mutable Clock::duration time_;
};

/// The finding's failure of a subject.
class SameFailure {
 public:
  SameFailure(const Finding& finding, const Subject& subject, const Stop& stop)
      : failure_{finding.what, finding.signature}, judge_(subject), stop_(stop) {}

  bool operator()(const Query& query) const {
    stop_.check(grace);
    try {
      return judge_.failure(query) == failure_;
    } catch (const isolation::PluginChanged&) {
      throw;
    } catch (const Error&) {
      return false;
    }
  }

 private:
  Failure failure_;
  Judge judge_;
  const Stop& stop_;
};

/// The search among small queries, and then the steps of the shrinker, may reach half of the limits each.
Query shrunk_failure_of_subject(const Finding& finding, const Subject& subject, const Stop& stop,
                                const ShrinkLimits& limits) {
  const Limited first(subject, limits.work / 2, limits.time / 2);
  const Limited second(subject, limits.work / 2, limits.time / 2);
  const SameFailure fails_at_first(finding, first, stop);
  const SameFailure fails(finding, second, stop);
  const bool every_query_is_slow = is_of_time_limit(finding.signature);
  const auto small = every_query_is_slow
                         ? std::nullopt
                         : simplest_small_failure(finding, first, std::cref(fails_at_first), stop, grace);
  return subject.rounded(shrunk(small.value_or(finding.query), std::cref(fails)));
}

}  // namespace

Query shrunk_query(const Finding& finding, const Subject* subject, const Stop& stop,
                   const ShrinkLimits& limits) {
  switch (finding.what) {
    case Finding::What::truth_mismatch:
      return finding.query;
    case Finding::What::oracle_disagreement:
      return shrunk(finding.query, [&](const Query& query) {
        stop.check(grace);
        return oracle_failure(query) == Failure{finding.what, finding.signature};
      });
    default:
      return shrunk_failure_of_subject(finding, *subject, stop, limits);
  }
}

}  // namespace nearmiss
