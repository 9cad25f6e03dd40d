#include "fuzz/subjects/isolation/isolated_plugin.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <map>
#include <mutex>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "ccd/query/error.hpp"
#include "ccd/subjects/described_subject.hpp"
#include "ccd/subjects/plugin.hpp"
#include "fuzz/parallel.hpp"
#include "fuzz/subjects/forwarding_subject.hpp"
#include "fuzz/subjects/isolation/fault_texts.hpp"

namespace nearmiss {

namespace {

using isolation::PluginCode;
using isolation::PluginLimits;
using isolation::Request;
using isolation::WorkerFailure;
using isolation::WorkerProcess;

/// The name of a plug-in, changed so that it chooses the detector `subject`.
std::string with_subject(const std::string& name, const std::string& subject) {
  const std::size_t path = PluginName::parse(name).path.size();
  return name.substr(0, path) + ":" + subject + name.substr(path);
}

bool has_text(Fault fault) { return fault == Fault::exception || fault == Fault::load; }

class IsolatedPlugin final : public DescribedSubject {
 public:
  /// `first` is a worker that has loaded the plug-in.
  IsolatedPlugin(std::shared_ptr<const PluginCode> code, const PluginLimits& limits,
                 std::unique_ptr<WorkerProcess> first)
      : DescribedSubject(first->info()), code_(std::move(code)), limits_(limits) {
    idle_.push_back(std::move(first));
  }
  IsolatedPlugin(const IsolatedPlugin&) = delete;
  IsolatedPlugin& operator=(const IsolatedPlugin&) = delete;
  ~IsolatedPlugin() override {
    // Calling dismiss() for all workers first makes all workers end at the same time.
    for (const auto& worker : idle_) worker->dismiss();
  }

  using DescribedSubject::decide;
  void decide(std::span<const Query> queries, std::span<Verdict> verdicts) const override {
    perform(Request::decide, queries, [&](const Done& done) { decide(done, verdicts); });
  }

  BatchTime decide_timed(std::span<const Query> queries, std::span<Verdict> verdicts) const override {
    BatchTime sum;
    perform(Request::decide_timed, queries, [&](const Done& done) {
      decide(done, verdicts);
      if (!done.is_whole) return;
      sum.queries += done.count;
      sum.nanoseconds += done.worker->measured();
      sum.kernel_nanoseconds += done.worker->measured_kernels();
    });
    return sum;
  }

  void time_each(std::span<const Query> queries,
                 std::span<std::optional<std::uint64_t>> nanoseconds) const override {
    perform(Request::time_each, queries, [&](const Done& done) {
      for (std::uint32_t i = 0; i < done.count; ++i) nanoseconds[done.first + i] = done.worker->measured(i);
      if (done.failure) nanoseconds[done.first + done.count].reset();
    });
  }

  [[nodiscard]] BoundAnswer ask_bound(const Query& query) const override {
    BoundAnswer bound;
    ask_bounds(std::span(&query, 1), std::span(&bound, 1));
    return bound;
  }

  void ask_bounds(std::span<const Query> queries, std::span<BoundAnswer> bounds) const override {
    perform(Request::bounds, queries, [&](const Done& done) {
      answer(done, bounds, [&](std::uint32_t i) { return BoundAnswer::given(done.worker->number(i)); });
    });
  }

  [[nodiscard]] DistanceAnswer ask_distance(const Query& query) const override {
    return ask<DistanceAnswer>(Request::distances, query, [](const WorkerProcess& worker) {
      std::array<double, 4> weights{};
      std::copy_n(worker.more().begin(), weights.size(), weights.begin());
      return DistanceAnswer::given(worker.number(0), weights);
    });
  }

  [[nodiscard]] StepAnswer ask_step(const Query& query) const override {
    return ask<StepAnswer>(Request::steps, query, [&](const WorkerProcess& worker) {
      return StepAnswer::given(worker.more(), worker.number(0), vertices(query.kind));
    });
  }

  [[nodiscard]] std::string fault_text(const Verdict& verdict) const override {
    return has_text(verdict.fault) ? texts_.text(verdict.fault_code) : "";
  }

  [[nodiscard]] std::string fault_errors(const Verdict& verdict) const override {
    const std::lock_guard lock(mutex_);
    const auto found = errors_.find({std::this_thread::get_id(), verdict.fault, verdict.fault_code});
    return found == errors_.end() ? "" : found->second;
  }

  [[nodiscard]] PluginIdentity identity() const {
    return {code_->name(), info().version, code_->sha256(), code_->build_id()};
  }

 private:
  /// The result of a call. The worker answered the first `count` queries of the call. If `failure` is set,
  /// the worker failed on the next query.
  struct Done {
    const WorkerProcess* worker;  ///< null if no worker could be started
    std::size_t first;            ///< index of the call's first query among all queries
    std::uint32_t count;          ///< number of queries that were answered
    const std::optional<WorkerFailure>& failure;
    bool is_whole;  ///< whether the worker answered all queries of the call
  };

  /// Asks a question about one query. given(worker) reads the answer from the worker.
  template <class Answer, class Given>
  Answer ask(Request request, const Query& query, const Given& given) const {
    Answer answer;
    perform(request, std::span(&query, 1), [&](const Done& done) {
      this->answer(done, std::span(&answer, 1), [&](std::uint32_t /*i*/) { return given(*done.worker); });
    });
    return answer;
  }

  /// Writes the answers to the queries of a call; given(i) reads the answer to query i from the worker.
  template <class Answer, class Given>
  void answer(const Done& done, std::span<Answer> answers, const Given& given) const {
    in_parts(done.count, [&](std::size_t first, std::size_t last) {
      for (auto i = static_cast<std::uint32_t>(first); i < last; ++i) answers[done.first + i] = given(i);
    });
    if (done.failure)
      answers[done.first + done.count] = {.fault = done.failure->fault, .fault_code = code_of(*done.failure)};
  }

  void decide(const Done& done, std::span<Verdict> verdicts) const {
    answer(done, verdicts, [&](std::uint32_t i) {
      return verdict_of(info(), done.worker->value(i), done.worker->number(i));
    });
  }

  /// Returns the fault code of a failure, for the verdict. Also stores in errors_ what the process wrote to
  /// standard error.
  std::int32_t code_of(const WorkerFailure& failure) const {
    const std::int32_t code = has_text(failure.fault) ? texts_.number(failure.text) : failure.code;
    if (failure.errors.empty()) return code;
    const std::lock_guard lock(mutex_);
    errors_[{std::this_thread::get_id(), failure.fault, code}] = failure.errors;
    return code;
  }

  [[nodiscard]] bool can_decide(const Query& query) const {
    return is_asked(query.kind, query.separation > 0);
  }

  /// The number of queries in the batch with which `queries` begins. All queries of a batch have the same
  /// kind, the plug-in can decide either all of them or none, and a worker can receive all of them in one
  /// call.
  [[nodiscard]] std::size_t batch_at(std::span<const Query> queries) const {
    const Query& first = queries.front();
    std::size_t count = 1;
    while (count < std::min(queries.size(), isolation::capacity_for(info())) &&
           queries[count].kind == first.kind && can_decide(queries[count]) == can_decide(first))
      ++count;
    return count;
  }

  /// Makes workers perform the request for all queries, batch by batch. Passes the result of each call to
  /// take_done().
  template <class Take>
  void perform(Request request, std::span<const Query> queries, const Take& take_done) const {
    in_parts(queries.size(), [&](std::size_t first, std::size_t last) {
      if (!std::ranges::all_of(queries.subspan(first, last - first), is_finite)) refuse_coordinates(name());
    });
    std::unique_ptr<WorkerProcess> worker = take();
    std::uint64_t late = 0;
    for (std::size_t start = 0; start < queries.size();) {
      const auto batch = queries.subspan(start, batch_at(queries.subspan(start)));
      perform_batch(worker, request, batch, late,
                    [&](std::uint32_t first, std::uint32_t end, const std::optional<WorkerFailure>& failure,
                        bool is_whole) {
                      take_done(Done{worker.get(), start + first, end - first, failure, is_whole});
                    });
      start += batch.size();
    }
    give_back(std::move(worker));
  }

  /// Makes a worker perform the request for one batch. If a worker cannot be used any more, a new worker
  /// replaces it and continues after the query that failed. If several queries may have caused a failure,
  /// these queries are asked again to find the query that is to blame: first in parts, then a failing part in
  /// smaller parts, and at last query by query. If a part fails, but none of its smaller parts fails, as with
  /// a crash at every 1000th query, the last query of the part is to blame. (If the part failed only because
  /// it took too long, no query is to blame, because the part's queries together may need that much time.)
  /// `late` counts the queries that exceeded the time limit.
  template <class Take>
  void perform_batch(std::unique_ptr<WorkerProcess>& worker, Request request, std::span<const Query> batch,
                     std::uint64_t& late, const Take& take_part) const {
    const bool is_decided = request != Request::distances && request != Request::steps;
    const bool is_asked = !is_decided || can_decide(batch.front());
    const auto size = static_cast<std::uint32_t>(batch.size());
    // The queries of each element are a part of the queries of the element before it.
    std::vector<Repeated> repeated;
    for (std::uint32_t first = 0; first < size;) {
      const bool is_left_out = !is_asked || (limits_.most_late != 0 && late >= limits_.most_late);
      if (is_left_out || !worker) {
        take_part(first, first,
                  is_left_out ? WorkerFailure{first, Fault::not_asked}
                              : WorkerFailure{.query = first, .fault = Fault::load, .text = why_not_loaded()},
                  false);
        ++first;
        continue;
      }
      const std::uint32_t end_of_call = repeated.empty() ? size : repeated.back().end;
      const std::uint32_t part = repeated.empty() ? in_a_call_.load() : repeated.back().part;
      const std::uint32_t last = first + std::min(end_of_call - first, part);
      std::optional<WorkerFailure> failure = worker->perform(request, batch.subspan(first, last - first));
      if (failure) failure->query += first;
      code_->expect_unchanged(*limits_.stop);  // a write to the file may change the code of running processes
      if (repeated.empty()) adapt(last - first, *worker, failure);
      if (failure && failure->suspects != 0) {
        take_part(first, failure->query, std::nullopt, false);
        first = failure->query;
        repeated.push_back({first + failure->suspects, part_of(failure->suspects),
                            failure->fault == Fault::time ? std::nullopt : failure});
      } else {
        const auto unexplained = std::ranges::find_if(
            repeated, [&](const Repeated& call) { return call.end == last && call.failure; });
        const bool is_last_to_blame = !failure && unexplained != repeated.end();
        const std::uint32_t end = failure ? failure->query : is_last_to_blame ? last - 1 : last;
        take_part(first, end, is_last_to_blame ? unexplained->failure : failure, end == last);
        if (failure || is_last_to_blame)
          for (Repeated& call : repeated) call.failure.reset();
        first = failure ? end + 1 : last;
        while (!repeated.empty() && repeated.back().end <= first) repeated.pop_back();
      }
      if (!failure) continue;
      late += failure->fault == Fault::time && failure->suspects == 0 ? 1 : 0;
      if (failure->goes_on) continue;
      worker = start_worker();
    }
  }

  /// Queries that are asked again in parts, to find the query that is to blame for a failure.
  struct Repeated {
    std::uint32_t end, part;
    /// The failure for which a query must be blamed; empty once a query has been blamed.
    std::optional<WorkerFailure> failure;
  };

  /// The size of the parts into which `size` queries are divided when they are asked again.
  static std::uint32_t part_of(std::uint32_t size) {
    constexpr std::uint32_t few = 4096;
    constexpr std::uint32_t parts = 64;
    return size <= few ? 1 : size / parts;
  }

  void adapt(std::uint32_t count, const WorkerProcess& worker,
             const std::optional<WorkerFailure>& failure) const {
    constexpr std::uint32_t fewer = 8;
    if (failure && failure->suspects != 0) in_a_call_ = std::max(1U, failure->suspects / fewer);
    const bool quick = !failure && fewer * worker.elapsed() < limits_.time;
    if (quick && count == in_a_call_)
      in_a_call_ = static_cast<std::uint32_t>(
          std::min<std::size_t>(2 * std::size_t{count}, isolation::capacity_for(info())));
  }

  std::unique_ptr<WorkerProcess> take() const {
    {
      const std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        auto worker = std::move(idle_.back());
        idle_.pop_back();
        return worker;
      }
    }
    return start_worker();
  }

  /// Starts a worker. Returns null if the plug-in cannot be loaded, or if the plug-in's description of itself
  /// has changed. After three failed starts in a row, this function starts no more workers.
  std::unique_ptr<WorkerProcess> start_worker() const {
    constexpr int most_failed = 3;
    if (failed_starts_ >= most_failed) return nullptr;
    try {
      auto worker = new_worker();
      if (worker->info() != info())
        throw Error(code_->name() + ": the plug-in says something else about itself than before");
      failed_starts_ = 0;
      return worker;
    } catch (const isolation::TrialError&) {
      throw;
    } catch (const Error& error) {
      const std::lock_guard lock(mutex_);
      why_not_loaded_ = error.what();
      ++failed_starts_;
      return nullptr;
    }
  }

  /// Starts a worker. If the system cannot start the worker's processes, tries again for ten seconds, and
  /// then throws NoWorker.
  std::unique_ptr<WorkerProcess> new_worker() const {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::seconds patience(10);
    constexpr std::chrono::milliseconds pause(10);
    for (const auto until = Clock::now() + patience;;) {
      try {
        return std::make_unique<WorkerProcess>(*code_, limits_);
      } catch (const isolation::NoWorker&) {
        if (Clock::now() >= until) throw;
      }
      limits_.stop->check(Stop::grace);
      std::this_thread::sleep_for(pause);
    }
  }

  std::string why_not_loaded() const {
    const std::lock_guard lock(mutex_);
    return why_not_loaded_;
  }

  void give_back(std::unique_ptr<WorkerProcess> worker) const {
    const std::lock_guard lock(mutex_);
    if (worker) idle_.push_back(std::move(worker));
  }

  std::shared_ptr<const PluginCode> code_;
  PluginLimits limits_;
  mutable std::atomic<std::uint32_t> in_a_call_ = static_cast<std::uint32_t>(isolation::capacity_for(info()));
  mutable FaultTexts texts_;
  mutable std::atomic<int> failed_starts_ = 0;  // number of failed starts since the last successful start
  mutable std::mutex mutex_;
  mutable std::string why_not_loaded_;  // the reason for the last failed start
  /// For each thread, fault and fault code: the text that the process wrote to standard error when this fault
  /// last happened to a query of this thread. A thread reads the text right after a fault, so it gets the
  /// text that belongs to this fault.
  mutable std::map<std::tuple<std::thread::id, Fault, std::int32_t>, std::string> errors_;
  mutable std::vector<std::unique_ptr<WorkerProcess>> idle_;
};

}  // namespace

std::vector<std::unique_ptr<Subject>> make_isolated_plugins(const std::string& name,
                                                            const PluginLimits& limits) {
  auto code = std::make_shared<const PluginCode>(name);
  auto first = std::make_unique<WorkerProcess>(*code, limits);
  const std::vector<std::string> names = first->names();
  const bool has_chosen = is_program(name) || !PluginName::parse(name).subject.empty();
  if (names.empty() && !has_chosen) throw Error(name + ": the plug-in's process described no detector");
  std::vector<std::unique_ptr<Subject>> subjects;
  if (has_chosen || names.size() == 1)
    subjects.push_back(std::make_unique<IsolatedPlugin>(std::move(code), limits, std::move(first)));
  else
    for (const std::string& each : names)
      subjects.push_back(make_isolated_plugin(with_subject(name, each), limits));
  return subjects;
}

std::unique_ptr<Subject> make_isolated_plugin(const std::string& name, const PluginLimits& limits) {
  auto subjects = make_isolated_plugins(name, limits);
  if (subjects.size() == 1) return std::move(subjects.front());
  std::string names;
  for (const auto& each : subjects) names += (names.empty() ? "" : ", ") + each->name();
  throw Error(name + ": found several detectors, expected one of " + names + " behind the path, such as " +
              name + ":" + subjects.front()->name());
}

std::optional<PluginIdentity> plugin_identity(const Subject& subject) {
  const auto* const plugin = dynamic_cast<const IsolatedPlugin*>(&innermost(subject));
  return plugin == nullptr ? std::nullopt : std::optional(plugin->identity());
}

const DetectorInfo* plugin_info(const Subject& subject) {
  const auto* const plugin = dynamic_cast<const IsolatedPlugin*>(&innermost(subject));
  return plugin == nullptr ? nullptr : &plugin->info();
}

}  // namespace nearmiss
