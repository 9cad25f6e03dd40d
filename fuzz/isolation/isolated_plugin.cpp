#include "fuzz/isolation/isolated_plugin.hpp"

#include <algorithm>
#include <limits>
#include <mutex>
#include <vector>

#include "ccd/error.hpp"
#include "ccd/plugin.hpp"

namespace nearmiss {

namespace {

using isolation::Failure;
using isolation::Limits;
using isolation::Order;
using isolation::Shared;
using isolation::WorkerProcess;

class IsolatedPlugin final : public Subject {
 public:
  IsolatedPlugin(std::string path, const Limits& limits) : path_(std::move(path)), limits_(limits) {
    idle_.push_back(std::make_unique<WorkerProcess>(path_, limits_));
    name_ = idle_.back()->shared().name.data();
    claims_bound_ = idle_.back()->shared().claims_bound;
  }

  [[nodiscard]] const std::string& name() const override { return name_; }

  [[nodiscard]] Verdict decide(const Query& query) const override {
    Verdict verdict;
    decide(std::span(&query, 1), std::span(&verdict, 1));
    return verdict;
  }

  void decide(std::span<const Query> queries, std::span<Verdict> verdicts) const override {
    std::vector<std::uint64_t> nanoseconds(queries.size());
    decide_timed(queries, verdicts, nanoseconds);
  }

  void decide_timed(std::span<const Query> queries, std::span<Verdict> verdicts,
                    std::span<std::uint64_t> nanoseconds) const override {
    std::unique_ptr<WorkerProcess> worker = take();
    for (std::size_t first = 0; first < queries.size();) {
      const std::size_t count = batch_at(queries.subspan(first));
      decide_batch(worker, queries.subspan(first, count), verdicts.subspan(first, count),
                   nanoseconds.subspan(first, count));
      first += count;
    }
    give_back(std::move(worker));
  }

  [[nodiscard]] bool is_remote() const override { return true; }
  [[nodiscard]] bool claims_bound() const override { return claims_bound_; }

  [[nodiscard]] double distance_bound(const Query& query) const override {
    std::unique_ptr<WorkerProcess> worker = take();
    fill(worker->shared(), std::span(&query, 1));
    if (worker->obey(Order::bounds)) return std::numeric_limits<double>::quiet_NaN();
    const double bound = worker->shared().answers[0].number;
    give_back(std::move(worker));
    return bound;
  }

 private:
  /// As many as are of one kind and have room.
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
      if (!is_finite(queries[i])) refuse_coordinates(name_);
      shared.queries[i] = queries[i].x;
    }
  }

  void decide_batch(std::unique_ptr<WorkerProcess>& worker, std::span<const Query> queries,
                    std::span<Verdict> verdicts, std::span<std::uint64_t> nanoseconds) const {
    fill(worker->shared(), queries);
    for (std::uint32_t first = 0; first < queries.size();) {
      worker->shared().first = first;
      const std::optional<Failure> failure = worker->obey(Order::decide);
      const auto end = failure ? failure->query : static_cast<std::uint32_t>(queries.size());
      for (; first < end; ++first) {
        const isolation::Answer& answer = worker->shared().answers[first];
        verdicts[first] = plugin_verdict(answer.value, answer.number);
        nanoseconds[first] = answer.nanoseconds;
      }
      if (!failure) break;
      verdicts[first] = {};
      verdicts[first].fault = failure->fault;
      verdicts[first].fault_code = failure->code;
      nanoseconds[first] = failure->nanoseconds;
      ++first;
      worker = std::make_unique<WorkerProcess>(path_, limits_);
      fill(worker->shared(), queries);
    }
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
  Limits limits_;
  std::string name_;
  bool claims_bound_;
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<WorkerProcess>> idle_;
};

}  // namespace

std::unique_ptr<Subject> make_isolated_plugin(const std::string& path, const Limits& limits) {
  return std::make_unique<IsolatedPlugin>(path, limits);
}

}  // namespace nearmiss
