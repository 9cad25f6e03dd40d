#include "fuzz/trial/shrunk_finding.hpp"

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

/// A subject that refuses further queries when its answers have taken as long as it may.
class Limited final : public ForwardingSubject {
  /// What the subject answers, unless its time is over.
  template <class Ask>
  auto asked(const Ask& ask) const {
    if (left_ <= Clock::duration::zero()) throw Error("the subject has answered as long as it may");
    const auto before = Clock::now();
    auto answer = ask();
    left_ -= Clock::now() - before;
    return answer;
  }

 public:
  Limited(const Subject& to, Clock::duration limit) : ForwardingSubject(to.name(), to), left_(limit) {}

  using ForwardingSubject::decide;
  void decide(std::span<const Query> queries, std::span<Verdict> verdicts) const override {
    asked([&] {
      to().decide(queries, verdicts);
      return true;
    });
  }
  [[nodiscard]] double distance_bound(const Query& query) const override {
    return asked([&] { return to().distance_bound(query); });
  }
  [[nodiscard]] BoundAnswer ask_bound(const Query& query) const override {
    return asked([&] { return to().ask_bound(query); });
  }

 private:
  mutable Clock::duration left_;
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

/// The search among small queries, and then the steps of the shrinker, may take half of the time each.
Query shrunk_failure_of_subject(const Finding& finding, const Subject& subject, const Stop& stop,
                                Clock::duration limit) {
  const Limited first(subject, limit / 2);
  const Limited second(subject, limit / 2);
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
                   std::chrono::milliseconds limit) {
  switch (finding.what) {
    case Finding::What::truth_mismatch:
      return finding.query;
    case Finding::What::oracle_disagreement:
      return shrunk(finding.query, [&](const Query& query) {
        stop.check(grace);
        return oracle_failure(query) == Failure{finding.what, finding.signature};
      });
    default:
      return shrunk_failure_of_subject(finding, *subject, stop, limit);
  }
}

}  // namespace nearmiss
