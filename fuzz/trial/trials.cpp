#include "fuzz/trial/trials.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <type_traits>
#include <utility>

#include "ccd/subjects/described_subject.hpp"
#include "fuzz/parallel.hpp"
#include "fuzz/subjects/forwarding_subject.hpp"
#include "fuzz/subjects/isolation/isolated_plugin.hpp"

namespace nearmiss {

namespace {

/// The queries [first, last) of a batch. The batch must outlive the result.
Batch slice(const Batch& batch, std::size_t first, std::size_t last) {
  const auto part = [&](const auto& all) {
    using All = std::decay_t<decltype(all)>;
    const auto at = [&](std::size_t i) { return all.begin() + static_cast<std::ptrdiff_t>(i); };
    return all.empty() ? All{} : All(at(first), at(last));
  };
  Batch own{.kind = batch.kind,
            .family = batch.family,
            .queries = part(batch.queries),
            .truths = part(batch.truths),
            .first_number = batch.number(first),
            .step = batch.step,
            .timed = batch.timed,
            .compare_all = batch.compare_all};
  const auto take_over = [first](auto& function, const auto& whole) {
    if (whole)
      function = [&whole, first](std::size_t i, const auto&... more) { return whole(first + i, more...); };
  };
  take_over(own.provenance, batch.provenance);
  take_over(own.place, batch.place);
  take_over(own.factors, batch.factors);
  take_over(own.observe, batch.observe);
  return own;
}

/// The largest number of queries that any of the subjects wants at once, but at least Pace::usual and at most
/// `most`.
std::size_t largest_batch_of(const Subjects& subjects) {
  constexpr std::size_t most = 1 << 16;
  std::size_t largest = Pace::usual;
  for (const auto& subject : subjects)
    if (const auto* const own = dynamic_cast<const DescribedSubject*>(&innermost(*subject)))
      largest = std::max(largest, own->info().batch);
  return std::min(largest, most);
}

/// The largest number of cases in a slice: `usual`, or a larger number if some subject is a plug-in. With
/// larger slices, each call of a plug-in's process asks about more cases, so that the calls take a smaller
/// part of the run time.
std::size_t largest_slice(const Subjects& subjects, std::size_t usual) {
  const auto is_plugin = [](const auto& each) { return plugin_info(*each) != nullptr; };
  return std::ranges::any_of(subjects, is_plugin) ? std::max(usual, 4 * Pace::usual) : usual;
}

std::uint64_t slow_in(const Statistics& statistics, const CountsKey& key) {
  const auto found = statistics.counts.find(key);
  return found == statistics.counts.end() ? 0 : found->second.without_answer(Fault::time);
}

}  // namespace

struct Trials::OnItsWay {
  Work work;
  TrialResult result = {};
  std::map<CountsKey, Known> before = {};  ///< what was known when the work began
  bool complete = true;
  Clock::time_point since = {};  ///< the end of the last trial
};

Trials::Trials(const Subjects& subjects, Comparison comparison, int jobs, const Stop& stop, bool shrink,
               TrialSink sink)
    : subjects_(subjects),
      comparison_(std::move(comparison)),
      jobs_(jobs),
      stop_(stop),
      sink_(std::move(sink)),
      batch_size_(largest_batch_of(subjects)),
      pace_(largest_slice(subjects, batch_size_)),
      shrinking_(subjects, jobs, stop, shrink) {}

void Trials::resume(const Statistics& before, const std::vector<Finding>& findings) {
  so_far_.take(before.counts);
  for (const Finding& finding : findings) shrinking_.add(finding);
}

void Trials::run(const std::function<std::optional<Work>()>& next) {
  const auto begin = [&]() -> std::optional<OnItsWay> {
    auto work = stop_.is_due() ? std::nullopt : next();
    if (!work) return std::nullopt;
    return OnItsWay{*std::move(work)};
  };
  in_order<OnItsWay>(
      jobs_, begin, [&](OnItsWay& item) { hold(item); }, [&](OnItsWay& item) { take(item); });
  pass_on();
}

void Trials::hold(OnItsWay& item) {
  item.result = {};
  item.before.clear();
  item.complete = true;
  item.since = Clock::now();
  try {
    item.work.hold([&](const Batch& batch) { ask(item, batch); });
  } catch (const Stopped&) {
    item.complete = false;
  }
  std::stable_sort(item.result.findings.begin(), item.result.findings.end(),
                   [](const Finding& a, const Finding& b) { return a.place < b.place; });
}

void Trials::ask(OnItsWay& item, const Batch& batch) {
  const std::size_t count = batch.queries.size();
  try {
    for (std::size_t first = 0, last = 0; first < count; first = last) {
      stop_.check();
      last = first + std::min(count - first, pace_.cases(batch.family));
      auto known = known_before(item, batch);
      const bool is_whole = last - first == count;
      item.result.merge(
          is_whole ? hold_trial(subjects_, batch, comparison_, std::move(known))
                   : hold_trial(subjects_, slice(batch, first, last), comparison_, std::move(known)));
      const auto now = Clock::now();
      pace_.took(batch.family, last - first, now - std::exchange(item.since, now));
    }
  } catch (const Stopped&) {
    item.complete = false;
  }
}

/// Returns, for each subject, the facts that the next trial of a piece of work takes into account: those that
/// were known when the work began, and the number of queries over the time limit in the earlier trials of
/// this work.
std::vector<Known> Trials::known_before(OnItsWay& item, const Batch& batch) const {
  std::vector<Known> known;
  for (const auto& subject : subjects_) {
    const CountsKey key{subject->name(), batch.kind, batch.family};
    const auto [before, is_new] = item.before.try_emplace(key);
    if (is_new) before->second = so_far_.of(key);
    known.push_back(before->second);
    known.back().slow += slow_in(item.result.statistics, key);
  }
  return known;
}

/// Whether a piece of work would ask the subjects about the same queries if it began again now.
bool Trials::knew_enough(const OnItsWay& item) const {
  return std::all_of(item.before.begin(), item.before.end(), [&](const auto& each) {
    const auto& [key, before] = each;
    const std::uint64_t slow = so_far_.of(key).slow;
    return before.is_set_aside() || slow == before.slow ||
           slow + slow_in(item.result.statistics, key) < most_slow;
  });
}

void Trials::take(OnItsWay& item) {
  if (!knew_enough(item)) hold(item);
  if (!item.work.counts(item.complete)) return;
  so_far_.take(item.result.statistics.counts);
  sum_.merge(std::move(item.result));
  pass_on_now_and_then();
}

void Trials::add(TrialResult&& result) {
  sum_.merge(std::move(result));
  pass_on();
}

void Trials::pass_on() {
  shrinking_.sift(sum_);
  sink_(std::exchange(sum_, {}));
  passed_on_ = Clock::now();
}

void Trials::pass_on_now_and_then() {
  if (constexpr std::chrono::milliseconds interval{100}; Clock::now() - passed_on_ >= interval) pass_on();
}

void Trials::finish(const std::function<void()>& report) {
  shrinking_.finish([&] {
    pass_on_now_and_then();
    report();
  });
  pass_on();
}

}  // namespace nearmiss
