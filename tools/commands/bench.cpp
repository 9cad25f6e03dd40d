// nearmiss bench: measures the run time of subjects.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "ccd/query/error.hpp"
#include "ccd/query/printable.hpp"
#include "corpus/readers.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/stop.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "oracle/filter/box.hpp"
#include "reports/text/json.hpp"
#include "tools/arguments.hpp"
#include "tools/bench_comparison.hpp"
#include "tools/bench_history.hpp"
#include "tools/commands.hpp"
#include "tools/fail_on.hpp"
#include "tools/json_output.hpp"
#include "tools/median.hpp"
#include "tools/record.hpp"
#include "tools/terminal.hpp"
#include "tools/values.hpp"

namespace nearmiss::tools {

namespace {

using Queries = std::map<Kind, std::vector<Query>>;

struct Options {
  std::vector<std::filesystem::path> paths;
  std::vector<std::string> subjects{"basic", "wang"};
  PluginLimitOptions limits;
  SeparationOption separation;
  std::uint64_t queries = 20000;
  int runs = 31;
  JsonOutput json;
  FailOnOption fail_on;
  std::filesystem::path history;
  std::vector<std::filesystem::path> compared;  ///< the histories before and after a change, or none
};

struct Input {
  std::string name;
  Queries queries;  ///< queries that pass the box test
};

/// Times of one subject on one input in ns per query, one entry for each run; NaN if it answered no query.
using RunTimes = std::vector<double>;

/// The name of an input, with the separation if one is given.
std::string named(std::string name, const SeparationOption& separation) {
  return separation.is_given() ? fmt::format("{}~{}", name, separation.text) : std::move(name);
}

/// For each kind, the first `count` queries of a family that pass the box test.
Input family_input(std::string_view name, std::uint64_t count, const SeparationOption& separation) {
  const Family family = find_family(name);
  Input input{named(std::string(name), separation), {}};
  for (std::uint64_t index = 0;
       std::ranges::any_of(kinds_of_meshes, [&](Kind kind) { return input.queries[kind].size() < count; });
       ++index) {
    const Query query = separation.apply(make_query(family, 1, index));
    if (auto& same = input.queries[query.kind]; same.size() < count && boxes_meet(query))
      same.push_back(query);
  }
  return input;
}

Input file_input(const std::filesystem::path& path, const SeparationOption& separation) {
  const auto whole = path.lexically_normal();
  const auto last = (whole.has_filename() ? whole : whole.parent_path()).filename();
  Input input{named(printable(last.string()), separation), {}};
  read_cases(path, [&](const Case& each) {
    const Query query = separation.apply(each.query);
    if (boxes_meet(query)) input.queries[query.kind].push_back(query);
  });
  if (input.queries.empty())
    throw Error(
        fmt::format("{}: found no query whose swept boxes meet, expected some to time", path.string()));
  return input;
}

/// Whether some queries have a separation.
bool any_separation(const std::vector<Query>& queries) {
  return std::ranges::any_of(queries, [](const Query& query) { return query.separation > 0; });
}

/// ns per query, measured as in a trial: one pass over the queries, repeated until it lasts long enough to be
/// timed. NaN if no query was answered.
double time_once(const Subject& subject, const std::vector<Query>& queries, std::vector<Verdict>& verdicts) {
  using std::chrono::steady_clock;
  const Kind kind = queries.front().kind;
  if (!subject.is_asked(kind, any_separation(queries))) return std::numeric_limits<double>::quiet_NaN();
  constexpr auto least = std::chrono::microseconds(500);
  const auto start = steady_clock::now();
  BatchTime sum;
  do {
    const BatchTime pass = subject.decide_timed(queries, verdicts);
    sum.queries += pass.queries;
    sum.nanoseconds += pass.nanoseconds;
  } while (steady_clock::now() - start < least);
  if (sum.queries == 0) return std::numeric_limits<double>::quiet_NaN();
  return std::max(1.0, static_cast<double>(sum.nanoseconds)) / static_cast<double>(sum.queries);
}

/// Counts the queries without an answer. The answers themselves are not judged.
void count_faults(const std::vector<Verdict>& verdicts, Counts& counts) {
  counts.queries += verdicts.size();
  for (const Verdict& each : verdicts)
    if (each.fault != Fault::none) ++counts.faults[static_cast<std::size_t>(each.fault)];
}

/// Times all subjects in turn, in every run, so that noise of the machine affects all of them alike.
/// Adds the queries and faults of each subject to `answered`.
std::vector<RunTimes> time_all(const Subjects& subjects, const std::vector<Query>& queries, int runs,
                               const Stop& stop, Statistics& answered) {
  std::vector<RunTimes> times(subjects.size());
  std::vector<Verdict> verdicts(queries.size());
  const Kind kind = queries.front().kind;
  for (int run = 0; run < runs; ++run)
    for (std::size_t s = 0; s < subjects.size(); ++s) {
      stop.check();
      times[s].push_back(time_once(*subjects[s], queries, verdicts));
      Counts& counts = answered.counts[{subjects[s]->name(), kind, ""}];
      if (subjects[s]->decides(kind)) count_faults(verdicts, counts);
    }
  return times;
}

/// The median, over the runs, of a subject's time divided by the first subject's time in the same run.
double median_ratio(const RunTimes& times, const RunTimes& first) {
  RunTimes ratios;
  for (std::size_t i = 0; i < times.size(); ++i) ratios.push_back(times[i] / first[i]);
  return median(ratios);
}

/// Times of all kinds together, each kind weighted by its number of queries.
std::vector<RunTimes> together(const std::vector<std::vector<RunTimes>>& by_kind,
                               const std::vector<double>& weights) {
  std::vector<RunTimes> sum(by_kind.front().size(), RunTimes(by_kind.front().front().size(), 0));
  double total = 0;
  for (const double weight : weights) total += weight;
  for (std::size_t k = 0; k < by_kind.size(); ++k)
    for (std::size_t s = 0; s < sum.size(); ++s)
      for (std::size_t i = 0; i < sum[s].size(); ++i) sum[s][i] += by_kind[k][s][i] * weights[k] / total;
  return sum;
}

std::vector<Input> inputs_of(const Options& options) {
  std::vector<Input> inputs;
  for (const auto& path : options.paths) inputs.push_back(file_input(path, options.separation));
  for (const std::string_view name : {"uniform", "uniform-end", "uniform-slow"})
    inputs.push_back(family_input(name, options.queries, options.separation));
  return inputs;
}

/// Throws Error if a subject can answer no kind of the queries that have a separation.
void expect_separations_of(const std::vector<Input>& inputs, const Subjects& subjects) {
  std::set<Kind> separated;
  for (const Input& input : inputs)
    for (const auto& [kind, queries] : input.queries)
      if (any_separation(queries)) separated.insert(kind);
  if (!separated.empty()) expect_separations(subjects, std::vector(separated.begin(), separated.end()));
}

/// A number with some decimals, as a table shows it.
std::string in_table(double number, int decimals) {
  return std::isnan(number) ? "no answer" : fmt::format("{:.{}f}", number, decimals);
}

/// Prints a line for each subject to `out`. `kind` is vt, ee or both.
void print_rows(std::FILE* out, const Subjects& subjects, const Input& input, std::string_view kind,
                std::size_t queries, const std::vector<RunTimes>& times) {
  for (std::size_t s = 0; s < subjects.size(); ++s)
    fmt::print(out, "{:<16} {:<5} {:>8}  {:<16} {:>9} {:>10}\n", input.name, kind, queries,
               subjects[s]->name(), in_table(median(times[s]), 1),
               in_table(median_ratio(times[s], times.front()), 3));
}

/// The results for all inputs that were timed.
struct Results {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  BenchRun run{.about = environment(), .times = {}};
  Statistics answered;  ///< only queries and faults
};

void add_rows(Results& results, const Subjects& subjects, const Input& input, Kind kind,
              const std::vector<RunTimes>& times) {
  for (std::size_t s = 0; s < subjects.size(); ++s) {
    results.run.times[{.input = input.name,
                       .kind = std::string(short_name(kind)),
                       .queries = input.queries.at(kind).size(),
                       .subject = subjects[s]->name()}] = times[s];
    results.json.push_back({{"subject", subjects[s]->name()},
                            {"kind", short_name(kind)},
                            {"input", input.name},
                            {"ns_per_query", median(times[s])},
                            {"runs", times[s].size()},
                            {"queries", input.queries.at(kind).size()},
                            {"ratio", median_ratio(times[s], times.front())}});
  }
}

/// Times, prints to `out` and records one input: each of its kinds, then both together.
void time_input(const Subjects& subjects, const Input& input, int runs, const Stop& stop, std::FILE* out,
                Results& results) {
  std::vector<std::vector<RunTimes>> by_kind;
  std::vector<double> weights;
  std::size_t count = 0;
  for (const auto& [kind, queries] : input.queries) {
    by_kind.push_back(time_all(subjects, queries, runs, stop, results.answered));
    print_rows(out, subjects, input, short_name(kind), queries.size(), by_kind.back());
    add_rows(results, subjects, input, kind, by_kind.back());
    weights.push_back(static_cast<double>(queries.size()));
    count += queries.size();
  }
  if (by_kind.size() > 1) print_rows(out, subjects, input, "both", count, together(by_kind, weights));
}

int compare(const Options& options) {
  fmt::print("{}", comparison_table(read_history(options.compared[0]), read_history(options.compared[1])));
  fmt::print(
      "\nns/query. ratio: median of after / before over the pairs of runs, with its 95 % confidence "
      "interval.\n");
  return exit_fine;
}

int run(const Options& options) {
  if (!options.compared.empty()) return compare(options);
  if (!options.history.empty() && std::filesystem::exists(options.history)) read_history(options.history);
  const Stop stop(interrupted());
  isolation::PluginLimits limits = options.limits.limits();
  limits.stop = &stop;
  const Subjects subjects = make_subjects(options.subjects, limits);
  const std::vector<Input> inputs = inputs_of(options);
  expect_separations_of(inputs, subjects);
  const std::string over = "/" + subjects.front()->name();
  std::FILE* const out = options.json.text();
  fmt::print(out, "{:<16} {:<5} {:>8}  {:<16} {:>9} {:>10}\n", "input", "kind", "queries", "subject",
             "ns/query", over);
  Results results;
  stop_on_signals();
  try {
    for (const Input& input : inputs) time_input(subjects, input, options.runs, stop, out, results);
  } catch (const Stopped&) {  // the inputs that were timed before the stop are still reported
  }
  if (!options.history.empty() && !stop.is_requested()) {
    results.run.about.merge(run_info("bench"));
    append_to_history(options.history, results.run);
  }
  end_on_signals();
  fmt::print(
      out,
      "\nQueries whose swept boxes meet. ns/query: without waiting for a processor, less that of an empty "
      "subject; "
      "median of {} runs, the subjects in turn in each; {}: median of the ratios within a run.\n",
      options.runs, over);
  options.json.write({{"results", results.json}});
  return stop.is_requested() ? exit_interrupted : options.fail_on.exit_code(results.answered);
}

}  // namespace

void add_bench(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand("bench", "Time subjects side by side, after the box test");
  command->add_option("PATH", options->paths,
                      "Files and folders of cases to time in addition to the random inputs");
  add_subject_option(*command, options->subjects);
  options->limits.add_to(*command);
  options->separation.add_to(*command);
  add_count_option(*command, "--queries", options->queries, 1, std::uint64_t{1} << 32,
                   "Number of random queries of each kind");
  add_count_option(*command, "--runs", options->runs, 1, 1'000'000, "Number of runs");
  options->json.add_to(*command, "Write the results as JSON");
  options->fail_on.add_to(*command);
  auto* history =
      command
          ->add_option("--history", options->history,
                       "Add all times of this run to a file, as a line of JSON, unless it is interrupted")
          ->type_name("FILE");
  command
      ->add_option(
          "--compare", options->compared,
          "Compare the runs in two such files, pair by pair, in place of timing: is what the second one has "
          "faster, slower, or within noise? Take the runs of both in turn (tools/bench-commits)")
      ->type_name("BEFORE AFTER")
      ->expected(2)
      ->excludes(history);
  command->footer(
      "\nRatios are relative to the first subject, so name the baseline first: --subject basic,wang");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace nearmiss::tools
