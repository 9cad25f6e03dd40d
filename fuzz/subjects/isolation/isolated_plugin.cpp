#include "fuzz/subjects/isolation/isolated_plugin.hpp"

#include <algorithm>
#include <limits>
#include <mutex>
#include <vector>

#include "ccd/error.hpp"
#include "ccd/plugin.hpp"
#include "fuzz/subjects/batch_subject.hpp"

namespace nearmiss {

namespace {

using isolation::PluginLimits;
using isolation::Request;
using isolation::Shared;
using isolation::WorkerFailure;
using isolation::WorkerProcess;

class IsolatedPlugin final : public BatchSubject {
 public:
  /// `first` is a worker that has loaded the plug-in at the path.
  IsolatedPlugin(std::string path, const PluginLimits& limits, std::unique_ptr<WorkerProcess> first)
      : BatchSubject(first->shared().name.data()),
        path_(std::move(path)),
        limits_(limits),
        claims_bound_(first->shared().claims_bound) {
    idle_.push_back(std::move(first));
  }

  using BatchSubject::decide;
  void decide(std::span<const Query> queries, std::span<Verdict> verdicts) const override {
    perform(Request::decide, queries, [&](const BatchPart& part) { part.answer(verdicts); });
  }

  BatchTime decide_timed(std::span<const Query> queries, std::span<Verdict> verdicts) const override {
    BatchTime sum;
    perform(Request::decide_timed, queries, [&](const BatchPart& part) {
      part.answer(verdicts);
      if (part.failure) return;
      sum.queries += part.end - part.first;
      sum.nanoseconds += part.shared.nanoseconds;
    });
    return sum;
  }

  void time_each(std::span<const Query> queries,
                 std::span<std::optional<std::uint64_t>> nanoseconds) const override {
    perform(Request::time_each, queries, [&](const BatchPart& part) {
      for (std::uint32_t i = part.first; i < part.end; ++i)
        nanoseconds[part.start + i] = part.shared.answers[i].nanoseconds;
      if (part.failure) nanoseconds[part.start + part.end].reset();
    });
  }

  [[nodiscard]] bool claims_bound() const override { return claims_bound_; }

  [[nodiscard]] double distance_bound(const Query& query) const override { return ask_bound(query).bound; }

  [[nodiscard]] BoundAnswer ask_bound(const Query& query) const override {
    std::unique_ptr<WorkerProcess> worker = take();
    fill(worker->shared(), std::span(&query, 1));
    if (const auto failure = worker->perform(Request::bounds))
      return {.fault = failure->fault, .fault_code = failure->code};
    const double bound = worker->shared().answers[0].number;
    give_back(std::move(worker));
    return BoundAnswer::given(bound);
  }

 private:
  /// The size of the next batch: queries of one kind, up to batch_size.
  static std::size_t batch_at(std::span<const Query> queries) {
    std::size_t count = 1;
    while (count < std::min(queries.size(), isolation::batch_size) && queries[count].kind == queries[0].kind)
      ++count;
    return count;
  }

  void fill(Shared& shared, std::span<const Query> queries) const {
    shared.kind = queries.front().kind;
    shared.first = 0;
    shared.count = static_cast<std::uint32_t>(queries.size());
    for (std::size_t i = 0; i < queries.size(); ++i) {
      if (!is_finite(queries[i])) refuse_coordinates(name());
      shared.queries[i] = queries[i].x;
    }
  }

  /// The part of a batch that one worker completed: queries [first, end), and a failure at `end` if the
  /// worker ended there.
  struct BatchPart {
    const Shared& shared;
    std::size_t start;  ///< index of the batch's first query among all queries
    std::uint32_t first, end;
    const std::optional<WorkerFailure>& failure;

    void answer(std::span<Verdict> verdicts) const {
      for (std::uint32_t i = first; i < end; ++i)
        verdicts[start + i] = plugin_verdict(shared.answers[i].value, shared.answers[i].number);
      if (failure) verdicts[start + end] = {.fault = failure->fault, .fault_code = failure->code};
    }
  };

  /// Performs a request for all queries, with a new worker after each query at which a worker ended.
  template <class Take>
  void perform(Request request, std::span<const Query> queries, const Take& take_part) const {
    std::unique_ptr<WorkerProcess> worker = take();
    for (std::size_t start = 0; start < queries.size();) {
      const auto batch = queries.subspan(start, batch_at(queries.subspan(start)));
      fill(worker->shared(), batch);
      for (std::uint32_t first = 0; first < batch.size();) {
        worker->shared().first = first;
        const std::optional<WorkerFailure> failure = worker->perform(request);
        const auto end = failure ? failure->query : static_cast<std::uint32_t>(batch.size());
        take_part(BatchPart{worker->shared(), start, first, end, failure});
        if (!failure) break;
        first = end + 1;
        worker = std::make_unique<WorkerProcess>(path_, limits_);
        fill(worker->shared(), batch);
      }
      start += batch.size();
    }
    give_back(std::move(worker));
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
    return std::make_unique<WorkerProcess>(path_, limits_);
  }

  void give_back(std::unique_ptr<WorkerProcess> worker) const {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(worker));
  }

  std::string path_;
  PluginLimits limits_;
  bool claims_bound_;
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<WorkerProcess>> idle_;
};

}  // namespace

std::unique_ptr<Subject> make_isolated_plugin(const std::string& path, const PluginLimits& limits) {
  return std::make_unique<IsolatedPlugin>(path, limits, std::make_unique<WorkerProcess>(path, limits));
}

}  // namespace nearmiss
