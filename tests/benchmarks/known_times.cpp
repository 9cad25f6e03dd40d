// Checks the times that the harness measures. The same arithmetic runs in a plain loop, in a built-in
// subject, and in a plug-in's own process. All three should take the same ns per query. Also measures what a
// plug-in's process costs: the ns of wall-clock time per query that a plug-in needs if it does nothing, for
// several sizes of batches. A campaign begins with batches of 50 queries, and soon has batches of 800.
#include <benchmark/benchmark.h>

#include <chrono>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "fuzz/subjects/isolation/isolated_plugin.hpp"
#include "tests/benchmarks/known_time.h"
#include "tests/benchmarks/measured.hpp"

namespace nearmiss {
namespace {

class KnownTime final : public Subject {
 public:
  explicit KnownTime(int steps) : steps_(steps) {}
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] Verdict decide(const Query& query) const override {
    return {.hit = known_time(query.x.data(), steps_) != 0};
  }
  using Subject::decide;
  [[nodiscard]] double distance_bound(const Query& /*query*/) const override { return 0; }

 private:
  int steps_;
  std::string name_ = "known";
};

const std::vector<Query>& queries() {
  static const auto all = uniform_queries(Kind::vertex_triangle, 32768);
  return all;
}

void set_time_per_query(benchmark::State& state, double nanoseconds) {
  state.SetIterationTime(1e-9 * nanoseconds / static_cast<double>(queries().size()));
}

void time_subject(benchmark::State& state, const Subject& subject) {
  std::vector<Verdict> verdicts(queries().size());
  for ([[maybe_unused]] const auto each : state) {
    const BatchTime time = subject.decide_timed(queries(), verdicts);
    set_time_per_query(state, static_cast<double>(time.nanoseconds));
  }
}

void time_plain_loop(benchmark::State& state, int steps) {
  using Clock = std::chrono::steady_clock;
  for ([[maybe_unused]] const auto each : state) {
    const auto start = Clock::now();
    for (const Query& query : queries()) benchmark::DoNotOptimize(known_time(query.x.data(), steps));
    set_time_per_query(state, std::chrono::duration<double, std::nano>(Clock::now() - start).count());
  }
}

/// Times a plug-in by the wall clock, because nearmiss and the plug-in's process also wait for each other.
void time_isolation(benchmark::State& state, const Subject& plugin, std::size_t batch) {
  using Clock = std::chrono::steady_clock;
  std::vector<Verdict> verdicts(batch);
  for ([[maybe_unused]] const auto each : state) {
    const auto start = Clock::now();
    for (std::size_t first = 0; first + batch <= queries().size(); first += batch)
      plugin.decide_timed(std::span(queries()).subspan(first, batch), verdicts);
    const auto asked = static_cast<double>(queries().size() / batch * batch);
    state.SetIterationTime(std::chrono::duration<double>(Clock::now() - start).count() / asked);
  }
}

}  // namespace
}  // namespace nearmiss

int main(int argc, char** argv) {
  using namespace nearmiss;
  std::vector<std::unique_ptr<Subject>> subjects;
  for (const int steps : {NEARMISS_KNOWN_STEPS}) {
    const std::string number = std::to_string(steps);
    const std::string plugin = NEARMISS_PLUGINS "/known_" + number + ".so";
    add_measured("loop/" + number, [=](benchmark::State& state) { time_plain_loop(state, steps); });
    for (const bool is_plugin : {false, true}) {
      subjects.push_back(is_plugin ? make_isolated_plugin(plugin) : std::make_unique<KnownTime>(steps));
      add_measured((is_plugin ? "plugin/" : "builtin/") + number,
                   [&subject = *subjects.back()](benchmark::State& state) { time_subject(state, subject); });
    }
  }
  const auto idle = make_isolated_plugin(NEARMISS_PLUGINS "/known_0.so");
  for (const std::size_t batch : {1U, 50U, 800U, 2000U})
    add_measured("isolation/" + std::to_string(batch),
                 [&idle, batch](benchmark::State& state) { time_isolation(state, *idle, batch); });
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
