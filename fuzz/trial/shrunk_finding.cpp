#include "fuzz/trial/shrunk_finding.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <utility>

#include "ccd/query/error.hpp"
#include "fuzz/families/classify.hpp"
#include "fuzz/subjects/forwarding_subject.hpp"
#include "fuzz/subjects/isolation/plugin_file.hpp"
#include "fuzz/trial/committed.hpp"
#include "fuzz/trial/judge.hpp"
#include "fuzz/trial/shrink.hpp"
#include "fuzz/trial/small_queries.hpp"
#include "fuzz/trial/versions.hpp"
#include "reports/statistics/failure.hpp"

namespace nearmiss {

namespace {

using Clock = std::chrono::steady_clock;

/// Whether the fault in a verdict may have ended the subject's process, so that the next query may need a new
/// process.
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

/// Passes queries on to a subject. Refuses further queries when a limit (ShrinkLimits) is reached. If
/// `stops_when_slow` is true, also refuses queries after a query on which the subject exceeds its time limit.
/// Once a subject has exceeded its time limit, it is asked one query at a time, so that it spends no time on
/// the queries that follow a slow query.
class Limited final : public ForwardingSubject {
  /// Calls `ask`, which asks the subject, and returns its answer. This uses up the work of one call and of
  /// `queries` queries. Throws Error if a limit is reached.
  template <class Ask>
  auto asked(std::size_t queries, const Ask& ask) const {
    if (work_ <= 0 || is_slow_) throw Error("the subject has answered as many queries as it may");
    if (time_ <= Clock::duration::zero()) throw Error("the subject has answered as long as it may");
    work_ -= ShrinkLimits::of_call + static_cast<std::int64_t>(queries);
    const auto before = Clock::now();
    auto answer = ask();
    time_ -= Clock::now() - before;
    return answer;
  }

 public:
  /// `has_been_slow` outlives this object, and is shared by all threads that ask the subject.
  Limited(const Subject& to, std::int64_t work, Clock::duration time, bool stops_when_slow,
          std::atomic<bool>& has_been_slow)
      : ForwardingSubject(to.name(), to),
        work_(work),
        time_(time),
        stops_when_slow_(stops_when_slow),
        has_been_slow_(has_been_slow) {}

  using ForwardingSubject::decide;
  void decide(std::span<const Query> queries, std::span<Verdict> verdicts) const override {
    std::fill(verdicts.begin(), verdicts.end(), Verdict{.fault = Fault::not_asked});
    const std::size_t at_once = has_been_slow_ ? 1 : std::max<std::size_t>(queries.size(), 1);
    for (std::size_t first = 0; first < queries.size() && !is_slow_; first += at_once)
      decide_some(queries.subspan(first, at_once), verdicts.subspan(first, at_once));
  }
  [[nodiscard]] double distance_bound(const Query& query) const override {
    return asked(1, [&] { return to().distance_bound(query); });
  }
  [[nodiscard]] BoundAnswer ask_bound(const Query& query) const override {
    return asked(1, [&] { return to().ask_bound(query); });
  }

 private:
  void decide_some(std::span<const Query> queries, std::span<Verdict> verdicts) const {
    asked(queries.size(), [&] {
      to().decide(queries, verdicts);
      return true;
    });
    work_ -= ShrinkLimits::of_process * std::count_if(verdicts.begin(), verdicts.end(), ends_process);
    const auto is_slow = [](const Verdict& each) { return each.fault == Fault::time; };
    if (std::none_of(verdicts.begin(), verdicts.end(), is_slow)) return;
    is_slow_ = stops_when_slow_;
    has_been_slow_ = true;
  }

  mutable std::int64_t work_;
  mutable Clock::duration time_;
  bool stops_when_slow_;
  mutable bool is_slow_ = false;
  std::atomic<bool>& has_been_slow_;
};

/// Whether an answer can be a failure of this kind. A verdict that reports a collision can also turn out to
/// be a fault, if it is a false positive for which the subject gives an invalid bound.
bool can_be(Finding::What what, const Verdict& verdict) {
  const bool is_fault = verdict.fault != Fault::none;
  switch (what) {
    case Finding::What::false_negative:
      return !is_fault && !verdict.hit;
    case Finding::What::refuted_bound:
    case Finding::What::late:
    case Finding::What::committed:
    case Finding::What::unsafe_step:
      return !is_fault && verdict.hit;
    default:
      return is_fault || verdict.hit;
  }
}

/// Finds queries on which the subject has a given failure.
class SameFailure {
 public:
  SameFailure(Failure failure, const Subject& subject, std::function<void()> check)
      : failure_(std::move(failure)), subject_(subject), judge_(subject), check_(std::move(check)) {}

  /// From now on, only queries that `queries` accepts count as failing.
  void only(const NoMoreExotic& queries) { only_ = queries; }

  /// From now on, only queries that `before` answers rightly count as failing. `before` must outlive this
  /// object.
  void only_since(const Subject& before) { before_.emplace(before); }

  /// Returns the index of the first query on which the subject has the given failure. Asks the subject about
  /// all queries at once; but if each query may end the subject's process, asks about a few queries at a
  /// time.
  std::optional<std::size_t> operator()(std::span<const Query> queries) const {
    const std::size_t at_once = failure_.what == Finding::What::fault ? 4 : queries.size();
    for (std::size_t first = 0; first < queries.size(); first += at_once) {
      const auto some = queries.subspan(first, std::min(at_once, queries.size() - first));
      if (const auto found = first_of(some)) return first + *found;
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] std::optional<std::size_t> first_of(std::span<const Query> queries) const {
    check_();
    try {
      std::vector<Verdict> verdicts(queries.size());
      subject_.decide(queries, verdicts);
      for (std::size_t i = 0; i < queries.size(); ++i)
        if (fails(queries[i], verdicts[i])) return i;
    } catch (const isolation::TrialError&) {
      throw;
    } catch (const Error&) {  // the subject refuses the queries
    }
    return std::nullopt;
  }

  [[nodiscard]] bool fails(const Query& query, const Verdict& verdict) const {
    return can_be(failure_.what, verdict) && judge_.failure(query, verdict) == failure_ &&
           (!only_ || (*only_)(subject_.rounded(query))) && (!before_ || (*before_)(subject_.rounded(query)));
  }

  Failure failure_;
  const Subject& subject_;
  Judge judge_;
  std::function<void()> check_;
  std::optional<NoMoreExotic> only_;
  std::optional<AnswersRightly> before_;
};

}  // namespace

/// A subject, and what is known about its failures: whether it has been slow, and on which small queries it
/// fails.
class FindingShrinker::OfSubject {
 public:
  OfSubject(const Subject& subject, const ShrinkLimits& limits) : subject_(subject), limits_(limits) {}

  [[nodiscard]] const std::string& name() const { return subject_.name(); }

  /// `before` is the earlier version of the CCD, which does not have this failure; null if no such version is
  /// known.
  void shrink(Finding& finding, const OfSubject* before, const std::function<void()>& check) const {
    const Query simplest = shrunk_of(finding, std::nullopt, before, check);
    const NoMoreExotic queries{finding.query_class, exoticness(finding.query, finding.query_class)};
    const bool is_exotic = finding.query_class != QueryClass::unclassified && !queries(simplest);
    finding.shrunk = is_exotic ? shrunk_of(finding, queries, before, check) : simplest;
    const bool is_simpler = complexity(finding.shrunk) < complexity(simplest);
    finding.simplest = is_simpler ? finding.shrunk : simplest;
    finding.simplest_class = is_simpler ? finding.query_class : classify(simplest);
    if (finding.what == Finding::What::fault)
      set(finding.errors, subject_.fault_errors(subject_.decide(finding.shrunk)));
    if (finding.shrunk == finding.query) return;
    if (has_time(finding.what)) set(finding.time, subject_.decide(finding.shrunk).time);
    if (has_step(finding.what))
      finding.step = committed_step(finding.shrunk, finding.time, subject_.rounds()).value_or(Query());
    else if (finding.what == Finding::What::refuted_bound)
      set(finding.bound, subject_.ask_bound(finding.shrunk).bound);
  }

 private:
  /// The simplest query on which the subject fails with the signature of the finding. If `among` is given,
  /// `among` must accept the query. If `before` is not null, the version `before` of the CCD must answer the
  /// query rightly.
  [[nodiscard]] Query shrunk_of(const Finding& finding, const std::optional<NoMoreExotic>& among,
                                const OfSubject* before, const std::function<void()>& check) const {
    const bool every_query_is_slow = failure_of(signature_of(finding)) == FailureKind::slow;
    const Limited limited = limited_subject(!every_query_is_slow);
    const Limited limited_before = before == nullptr ? limited_subject() : before->limited_subject();
    SameFailure same({finding.what, finding.signature}, limited, check);
    if (among) same.only(*among);
    if (before != nullptr) same.only_since(limited_before);
    const auto small =
        every_query_is_slow
            ? std::nullopt
            : small_failures(finding.query, check).simplest({finding.what, finding.signature}, among);
    const bool begins_small = small && small->complexity < complexity(finding.query) &&
                              (before == nullptr || same(std::span(&small->query, 1)));
    return subject_.rounded(shrunk(begins_small ? small->query : finding.query, std::cref(same)));
  }

  [[nodiscard]] Limited limited_subject(bool stops_when_slow = true) const {
    return {subject_, limits_.work / 2, limits_.time / 2, stops_when_slow, has_been_slow_};
  }

  /// The small queries on which the subject fails. They have the same kind as `query`, and they have
  /// separations only if `query` has one.
  const SmallFailures& small_failures(const Query& query, const std::function<void()>& check) const {
    const bool apart = query.separation != 0;
    const std::lock_guard lock(mutex_);
    auto& known = small_[{query.kind, apart}];
    if (!known) {
      const Limited limited = limited_subject();
      known.emplace(limited, query.kind, apart, check);
    }
    return *known;
  }

  /// Replaces a value of the finding, which belongs to the original query, by the value for the shrunk query.
  /// Does nothing if the value for the shrunk query is missing (NaN or "").
  static void set(double& number, double of_shrunk) {
    if (!std::isnan(of_shrunk)) number = of_shrunk;
  }
  static void set(std::string& text, std::string of_shrunk) {
    if (!of_shrunk.empty()) text = std::move(of_shrunk);
  }

  const Subject& subject_;
  const ShrinkLimits& limits_;
  mutable std::atomic<bool> has_been_slow_ = false;
  mutable std::mutex mutex_;
  mutable std::map<std::pair<Kind, bool>, std::optional<SmallFailures>> small_;
};

FindingShrinker::FindingShrinker(std::span<const Subject* const> subjects, const Stop& stop,
                                 const ShrinkLimits& limits)
    : stop_(stop), limits_(limits) {
  for (const Subject* subject : subjects) of_.push_back(std::make_unique<OfSubject>(*subject, limits_));
}

FindingShrinker::~FindingShrinker() = default;

const FindingShrinker::OfSubject* FindingShrinker::of(const std::string& name) const {
  const auto found =
      std::find_if(of_.begin(), of_.end(), [&](const auto& each) { return each->name() == name; });
  return found == of_.end() ? nullptr : found->get();
}

void FindingShrinker::shrink(Finding& finding, const Rest& rest) const {
  const auto check = [&] {
    stop_.check(Stop::grace);
    if (rest) rest();
  };
  switch (finding.what) {
    case Finding::What::truth_mismatch:
      break;
    case Finding::What::oracle_disagreement: {
      const Failure failure{finding.what, finding.signature};
      finding.shrunk = shrunk(finding.query, [&](std::span<const Query> queries) {
        const auto first = std::find_if(queries.begin(), queries.end(), [&](const Query& query) {
          check();
          return oracle_failure(query) == failure;
        });
        return first == queries.end() ? std::nullopt : std::optional<std::size_t>(first - queries.begin());
      });
      finding.simplest = finding.shrunk;
      break;
    }
    default:
      of(finding.subject)->shrink(finding, of(finding.broken_since), check);
  }
  finding.is_shrunk = true;
}

Query shrunk_query(const Finding& finding, const Subject* subject, const Stop& stop,
                   const ShrinkLimits& limits) {
  Finding copy = finding;
  if (subject != nullptr) copy.subject = subject->name();
  const std::size_t count = subject == nullptr ? 0 : 1;
  FindingShrinker(std::span(&subject, count), stop, limits).shrink(copy);
  return copy.shrunk;
}

}  // namespace nearmiss
