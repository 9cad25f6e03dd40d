// Measures how much longer a query takes through the C and C++ interfaces than through Subject::decide, which
// the harness calls. The subjects `exact-decision` and `wang` decide queries of the uniform family whose
// swept boxes meet. Times are ns of processor time per query. The number after a benchmark's name is the
// number of queries: 3,000 stay in the caches, 100,000 do not. With the option below, the benchmarks take
// turns. Read the medians in the output:
//   interfaces --benchmark_enable_random_interleaving=true
#include <benchmark/benchmark.h>

#include <numeric>
#include <string>
#include <vector>

#include "fuzz/subjects/built_in.hpp"
#include "oracle/filter/box.hpp"
#include "oracle/interface/nearmiss.hpp"
#include "tests/benchmarks/measured.hpp"

namespace nearmiss {
namespace {

/// Queries whose swept boxes meet, in several layouts that the interfaces accept, and room for the answers.
struct Input {
  std::vector<Query> queries;
  std::vector<double> x, start, end;
  std::vector<float> single;
  std::vector<std::int32_t> vertices;
  std::vector<std::int8_t> answers;
  std::vector<Verdict> verdicts;

  Input(Kind kind, std::size_t count) {
    for (const Query& query : uniform_queries(kind, 4 * count))
      if (queries.size() < count && boxes_meet(query)) queries.push_back(query);
    for (const Query& query : queries) {
      x.insert(x.end(), query.x.begin(), query.x.end());
      start.insert(start.end(), query.x.begin(), query.x.begin() + 12);
      end.insert(end.end(), query.x.begin() + 12, query.x.end());
    }
    single.assign(x.begin(), x.end());
    vertices.resize(4 * queries.size());
    std::iota(vertices.begin(), vertices.end(), 0);
    answers.resize(queries.size());
    verdicts.resize(queries.size());
  }
};

template <class Ask>
void measure(const std::string& name, std::size_t count, const Ask& ask) {
  benchmark::RegisterBenchmark(
      (name + "/" + std::to_string(count)).c_str(),
      [count, ask](benchmark::State& state) {
        for (auto _ : state) ask();
        state.counters["ns"] =
            benchmark::Counter(1e-9 * static_cast<double>(count),
                               benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
      })
      ->Repetitions(15)
      ->ReportAggregatesOnly()
      ->MinTime(0.05);
}

void measure_all(Kind kind, std::size_t count) {
  auto* const input = new Input(kind, count);  // lives as long as the benchmarks
  count = input->queries.size();
  const std::string of(short_name(kind));
  for (const std::string name : {"exact-decision", "wang"}) {
    const Subject* const subject = make_built_in(name).release();
    measure(of + "/" + name + "/harness", count, [=] { subject->decide(input->queries, input->verdicts); });
    const auto through = [&](const std::string& interface, const Queries& queries) {
      const bool is_exact = name == "exact-decision";
      measure(of + "/" + name + "/" + interface, count,
              [=] { (void)(is_exact ? collides(queries, input->answers) : wang(queries, input->answers)); });
    };
    const Queries packed = Queries::packed(kind, input->x);
    through("C++ packed", packed);
    through("C++ mesh", Queries::of_mesh(kind, input->vertices, input->start.data(), input->end.data()));
    through("C++ float", Queries::packed(kind, input->single));
    const nearmiss_queries layout = packed.layout();
    measure(of + "/" + name + "/C packed", count, [=] {
      (void)(name == "wang" ? nearmiss_wang(&layout, input->answers.data())
                            : nearmiss_collides(&layout, input->answers.data(), nullptr));
    });
  }
}

}  // namespace
}  // namespace nearmiss

int main(int count, char** arguments) {
  benchmark::Initialize(&count, arguments);
  for (const nearmiss::Kind kind : nearmiss::kinds_of_meshes)
    for (const std::size_t size : {3000, 100000}) nearmiss::measure_all(kind, size);
  benchmark::RunSpecifiedBenchmarks();
}
