// Measures how long the oracle takes to judge a subject, in ns of processor time per query whose swept boxes
// meet. The benchmark `decision` only decides the queries. The others also judge times that a subject gives
// for collisions, as a trial does: is the time late, that is, after the earliest time t*? The times are
//   early   t* - 1e-6, at least 0, like the times of a conservative CCD;
//   exact   the largest double that is not after t*, like the times of the subject `exact`, which are the
//           hardest to judge;
//   late    t* + 1e-6, at most 1.
// The inputs are the uniform family, and the files and folders of cases that are named as arguments. Each
// input is asked with the separations 0, 0.01 and 0.1. All benchmarks take turns, so noise of the machine
// affects all of them alike. The column Time has ns per query:
//   oracle_speed shared/queries
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <exception>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/readers.hpp"
#include "fuzz/trial/truth.hpp"
#include "oracle/filter/box.hpp"
#include "oracle/oracle.hpp"
#include "tests/benchmarks/measured.hpp"

namespace nearmiss {
namespace {

/// Queries of one kind, with one separation, whose swept boxes meet.
struct Input {
  std::vector<Query> queries;
  std::vector<Enclosure> times;  ///< narrowest enclosures of the queries' t*; computed when needed

  Input(const std::vector<Query>& of_kind, double h) {
    for (const Query& contact : of_kind)
      if (const Query query = with_separation(contact, h); boxes_meet(query)) queries.push_back(query);
  }

  void find_times() {
    if (!times.empty()) return;
    for (const Query& query : queries) {
      auto time = earliest_time(query);
      times.push_back(time ? time->enclosure() : Enclosure{});
    }
  }
};

/// Computes, from an enclosure of t*, the time that a subject gives.
using GiveTime = double (*)(const Enclosure& earliest);

double processor_nanoseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

/// Decides all queries. Unless `give` is null, also judges the times that `give` returns for collisions.
/// Returns how many of these times are late.
std::size_t judge(const Input& input, GiveTime give, std::vector<Decision>& decisions) {
  decide(input.queries, decisions);
  std::size_t late = 0;
  if (give == nullptr) return late;
  for (std::size_t i = 0; i < decisions.size(); ++i)
    if (decisions[i].collision) {
      Truth truth(input.queries[i], decisions[i]);
      late += truth.time().makes_late(give(input.times[i])) ? 1 : 0;
    }
  return late;
}

void add(const std::string& name, const std::shared_ptr<Input>& input, GiveTime give) {
  const auto measure = [input, give](benchmark::State& state) {
    if (give != nullptr) input->find_times();
    std::vector<Decision> decisions(input->queries.size());
    for ([[maybe_unused]] const auto each : state) {
      const double start = processor_nanoseconds();
      benchmark::DoNotOptimize(judge(*input, give, decisions));
      const double spent = processor_nanoseconds() - start;
      state.SetIterationTime(1e-9 * spent / static_cast<double>(input->queries.size()));
    }
  };
  add_measured(name, measure);
}

void add_all(const std::string& name, const std::map<Kind, std::vector<Query>>& queries) {
  for (const auto& [kind, same] : queries)
    for (const std::string_view h : {"0", "0.01", "0.1"}) {
      const auto input = std::make_shared<Input>(same, std::stod(std::string(h)));
      const std::string row = name + "/" + std::string(short_name(kind)) + "/h=" + std::string(h) + "/";
      add(row + "decision", input, nullptr);
      add(row + "early", input, [](const Enclosure& t) { return std::max(t.lo - 1e-6, 0.0); });
      add(row + "exact", input, [](const Enclosure& t) { return t.lo; });
      add(row + "late", input, [](const Enclosure& t) { return std::min(t.lo + 1e-6, 1.0); });
    }
}

std::map<Kind, std::vector<Query>> cases(const std::filesystem::path& path) {
  std::map<Kind, std::vector<Query>> queries;
  read_cases(path, [&](const Case& each) { queries[each.query.kind].push_back(each.query); });
  return queries;
}

}  // namespace
}  // namespace nearmiss

int main(int argc, char** argv) {
  using namespace nearmiss;
  std::vector<char*> arguments(argv, argv + argc);
  std::string in_turn = "--benchmark_enable_random_interleaving=true";
  arguments.insert(arguments.begin() + 1, in_turn.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  try {
    std::map<Kind, std::vector<Query>> uniform;
    for (const Kind kind : kinds_of_meshes) uniform[kind] = uniform_queries(kind, 20000);
    add_all("uniform", uniform);
    for (int i = 1; i < count; ++i) {
      const std::filesystem::path path(arguments[static_cast<std::size_t>(i)]);
      add_all(path.filename().string(), cases(path));
    }
  } catch (const std::exception& exception) {
    std::cerr << exception.what() << "\n";
    return 2;
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
