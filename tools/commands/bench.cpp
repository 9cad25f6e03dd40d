// nearmiss bench: measures the run time of subjects.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "ccd/query/error.hpp"
#include "ccd/query/printable.hpp"
#include "corpus/query_text.hpp"
#include "corpus/readers.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/parallel.hpp"
#include "fuzz/stop.hpp"
#include "fuzz/subjects/isolation/room.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "oracle/filter/box.hpp"
#include "reports/text/json.hpp"
#include "tools/arguments.hpp"
#include "tools/bench_history.hpp"
#include "tools/commands.hpp"
#include "tools/outputs.hpp"
#include "tools/record.hpp"
#include "tools/terminal.hpp"
#include "tools/timing.hpp"

namespace nearmiss::tools {

namespace {

using Queries = std::map<Kind, std::vector<Query>>;

struct BenchOptions {
  std::vector<std::filesystem::path> paths;
  std::vector<std::string> subjects{"basic", "wang"};
  PluginLimitOptions limits;
  SeparationOption separation;
  std::vector<std::string> families{"uniform", "uniform-end", "uniform-slow"};
  std::vector<std::string> kinds;  ///< the kinds of the random queries; if empty, all kinds that a family has
  std::uint64_t queries = 20000;
  int runs = 31;
  bool judge = false;
  JsonOutput json;
  FailOnOption fail_on;
  std::filesystem::path history;
  /// The two histories to compare, from before and after a change; empty without --compare.
  std::vector<std::filesystem::path> compared;
};

struct Input {
  std::string name;
  Queries queries;  ///< queries that pass the box test
};

std::string named(std::string name, const SeparationOption& separation) {
  return separation.is_given() ? fmt::format("{}~{}", name, separation.text) : std::move(name);
}

/// Makes an input, on all processors. For each kind that is asked, the input has the first `count` queries of
/// a family that pass the box test. A query passes the box test if the boxes that its primitives sweep
/// overlap. Throws Error if fewer than one query in 1000 passes, and Stopped if the user ends the command.
Input family_input(const Family& family, std::uint64_t count, const SeparationOption& separation,
                   const Stop& stop) {
  Input input{named(family.name, separation), {}};
  for (const Kind kind : kinds_asked(family)) input.queries[kind].reserve(count);
  const auto lacks = [&](Kind kind) { return input.queries[kind].size() < count; };
  const std::uint64_t most_at_once = 1 << 18;
  std::vector<std::optional<Query>> made(std::clamp<std::uint64_t>(2 * count, 64, most_at_once));
  const QueryMaker make(family, 1);
  const std::uint64_t most = 1000 * (count + made.size());
  for (std::uint64_t first = 0; std::ranges::any_of(kinds_asked(family), lacks); first += made.size()) {
    if (first > most)
      throw Error(fmt::format("{}: found less than one query in 1000 whose swept boxes meet, expected more",
                              family.name));
    in_parts(made.size(), [&](std::size_t begin, std::size_t end) {
      stop.check();
      for (std::size_t i = begin; i < end; ++i) {
        made[i].reset();
        if (const Kind kind = kind_of(family, first + i); !input.queries.contains(kind) || !lacks(kind))
          continue;
        const Query query = separation.apply(make(first + i));
        if (boxes_meet(query)) made[i] = query;
      }
    });
    for (const auto& query : made)
      if (query && lacks(query->kind)) input.queries[query->kind].push_back(*query);
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

/// The median, over the runs, of a subject's time divided by the first subject's time in the same run.
double median_ratio(const RunTimes& times, const RunTimes& first) {
  RunTimes ratios;
  for (std::size_t i = 0; i < times.size(); ++i) ratios.push_back(times[i] / first[i]);
  return median(ratios);
}

/// The subjects' times for the queries of all kinds together. The time for each kind is weighted by the
/// number of queries of this kind.
std::vector<Measured> together(const std::vector<std::vector<Measured>>& by_kind,
                               const std::vector<double>& weights) {
  const std::size_t runs = by_kind.front().front().times.size();
  const RunTimes none(runs, std::numeric_limits<double>::quiet_NaN());
  std::vector<Measured> sum(by_kind.front().size(), {RunTimes(runs, 0), none, none});
  double total = 0;
  for (const double weight : weights) total += weight;
  for (std::size_t k = 0; k < by_kind.size(); ++k)
    for (std::size_t s = 0; s < sum.size(); ++s)
      for (std::size_t i = 0; i < runs; ++i) sum[s].times[i] += by_kind[k][s].times[i] * weights[k] / total;
  return sum;
}

std::vector<Family> families_of(const BenchOptions& options) {
  std::vector<Kind> kinds;
  for (const std::string& each : options.kinds) kinds.push_back(parse_kind(each, "--kind"));
  std::vector<Family> families;
  for (const std::string& name : options.families) {
    families.push_back(as_asked(find_family(name)));
    for (const Kind kind : kinds) expect_kind(families.back(), kind, "--kind");
    if (!kinds.empty()) families.back() = of_kinds(families.back(), kinds).value();
  }
  return families;
}

/// Throws Error if there is not enough memory for the random queries of the largest family, the answers, and
/// the memory that nearmiss shares with each plug-in.
void expect_room(const BenchOptions& options, const std::vector<Family>& families, const Subjects& subjects,
                 const isolation::PluginLimits& limits) {
  std::uint64_t bytes = options.queries * sizeof(Verdict);
  for (const auto& subject : subjects)
    if (const DetectorInfo* const info = plugin_info(*subject))
      bytes += isolation::memory_of_batch(*info, options.queries, limits);
  std::uint64_t most = 0;
  for (const Family& family : families)
    most = std::max(most, kinds_asked(family).size() * options.queries * sizeof(Query));
  isolation::expect_memory(fmt::format("--queries {}", options.queries), bytes + most);
}

/// Finds the kinds of those queries that have a separation, and calls expect_separations() for these kinds.
void expect_separations_of(const std::vector<Input>& inputs, const std::vector<Family>& families,
                           const BenchOptions& options, const Subjects& subjects) {
  std::set<Kind> separated;
  for (const Input& input : inputs)
    for (const auto& [kind, queries] : input.queries)
      if (any_separation(queries)) separated.insert(kind);
  const bool all_for_contact = options.separation.is_given() && options.separation.of_families().empty();
  for (const Family& family : families)
    if (options.separation.is_given() ? !all_for_contact : family.has_separation)
      separated.insert(kinds_asked(family).begin(), kinds_asked(family).end());
  if (!separated.empty()) expect_separations(subjects, std::vector(separated.begin(), separated.end()));
}

std::string in_table(double number, int decimals) {
  return std::isnan(number) ? "no answer" : fmt::format("{:.{}f}", number, decimals);
}

/// Prints a line for each subject to `out`. `kind` is the name of a kind, or "both".
void print_rows(std::FILE* out, const Subjects& subjects, const Input& input, std::string_view kind,
                std::size_t queries, const std::vector<Measured>& measured) {
  for (std::size_t s = 0; s < subjects.size(); ++s) {
    const Measured& own = measured[s];
    fmt::print(out, "{:<16} {:<5} {:>8}  {:<16} {:>9} {:>10}", input.name, kind, queries, subjects[s]->name(),
               in_table(median(own.times), 1), in_table(median_ratio(own.times, measured.front().times), 3));
    const double throughput = median(own.throughput);
    if (!std::isnan(throughput)) fmt::print(out, " {:>12.0f}", throughput);
    if (!std::isnan(median(own.kernels))) fmt::print(out, " {:>9.1f}", median(own.kernels));
    if (own.judged)
      fmt::print(out, "  misses {} of {}, reports {} of {} others", own.judged->false_negatives,
                 own.judged->collisions, own.judged->false_positives, own.judged->others());
    fmt::print(out, "\n");
  }
}

struct Results {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  BenchRun run{.about = environment(), .times = {}};
  /// Each subject's numbers of queries and faults and, if answers are judged, of collisions and misses.
  Statistics answered;
};

void add_rows(Results& results, const Subjects& subjects, const Input& input, Kind kind,
              const std::vector<Measured>& measured) {
  for (std::size_t s = 0; s < subjects.size(); ++s) {
    const RunTimes& times = measured[s].times;
    results.run.times[{.input = input.name,
                       .kind = std::string(short_name(kind)),
                       .queries = input.queries.at(kind).size(),
                       .subject = subjects[s]->name()}] = times;
    results.json.push_back({{"subject", subjects[s]->name()},
                            {"kind", short_name(kind)},
                            {"input", input.name},
                            {"ns_per_query", median(times)},
                            {"runs", times.size()},
                            {"queries", input.queries.at(kind).size()},
                            {"ratio", median_ratio(times, measured.front().times)}});
    const auto add = [&](const char* name, const RunTimes& numbers) {
      if (const double number = median(numbers); !std::isnan(number)) results.json.back()[name] = number;
    };
    add("queries_per_second", measured[s].throughput);
    add("ns_per_query_of_kernels", measured[s].kernels);
    if (const auto& judged = measured[s].judged)
      results.json.back().update({{"collisions", judged->collisions},
                                  {"false_negatives", judged->false_negatives},
                                  {"others", judged->others()},
                                  {"false_positives", judged->false_positives}});
  }
}

/// Times the subjects on the queries of one input: for each kind of query separately, and for all kinds
/// together. Prints the times to `out`, and adds them to `results`.
void time_input(const Subjects& subjects, const Input& input, const BenchOptions& options, const Stop& stop,
                std::FILE* out, Results& results) {
  std::vector<std::vector<Measured>> by_kind;
  std::vector<double> weights;
  std::size_t count = 0;
  for (const auto& [kind, queries] : input.queries) {
    by_kind.push_back(time_all(subjects, queries, options.runs, options.judge, stop, results.answered));
    print_rows(out, subjects, input, short_name(kind), queries.size(), by_kind.back());
    add_rows(results, subjects, input, kind, by_kind.back());
    weights.push_back(static_cast<double>(queries.size()));
    count += queries.size();
  }
  if (by_kind.size() > 1) print_rows(out, subjects, input, "both", count, together(by_kind, weights));
}

int compare(const BenchOptions& options) {
  fmt::print("{}", comparison_table(read_history(options.compared[0]), read_history(options.compared[1])));
  fmt::print(
      "\nns/query. ratio: median of after / before over the pairs of runs, with its 95 % confidence "
      "interval.\n");
  return exit_fine;
}

int run(const BenchOptions& options) {
  if (!options.compared.empty()) return compare(options);
  if (!options.history.empty() && std::filesystem::exists(options.history)) read_history(options.history);
  const Stop stop(interrupted());
  isolation::PluginLimits limits = options.limits.limits();
  limits.stop = &stop;
  const Subjects subjects = make_subjects(options.subjects, limits);
  const std::vector<Family> families = families_of(options);
  std::vector<Input> files;
  for (const auto& path : options.paths) files.push_back(file_input(path, options.separation));
  expect_separations_of(files, families, options, subjects);
  expect_room(options, families, subjects, limits);
  const bool has_plugin =
      std::ranges::any_of(subjects, [](const auto& each) { return plugin_info(*each) != nullptr; });
  const std::string over = "/" + subjects.front()->name();
  std::FILE* const out = options.json.text();
  fmt::print(out, "{:<16} {:<5} {:>8}  {:<16} {:>9} {:>10}{}\n", "input", "kind", "queries", "subject",
             "ns/query", over, has_plugin ? "    queries/s   kernels" : "");
  Results results;
  stop_on_signals();
  try {
    const auto time = [&](const Input& input) { time_input(subjects, input, options, stop, out, results); };
    std::ranges::for_each(files, time);
    // Makes the queries of one family at a time, because the queries of all families need much memory.
    for (const Family& family : families)
      time(family_input(family, options.queries, options.separation, stop));
  } catch (const Stopped&) {  // the code below still reports the inputs that were timed before the stop
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
  if (has_plugin)
    fmt::print(
        out,
        "queries/s: of wall-clock time, with the passing of queries to the plug-in's process and of answers "
        "back. kernels: ns/query without copies to a device, if the plug-in says it.\n");
  options.json.write({{"results", results.json}});
  return stop.is_requested() ? exit_interrupted : options.fail_on.exit_code(results.answered);
}

}  // namespace

void add_bench(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<BenchOptions>();
  auto* command = app.add_subcommand("bench", "Time subjects side by side, after the box test");
  command->add_option("PATH", options->paths,
                      "Files and folders of cases to time in addition to the random inputs");
  add_subject_option(*command, options->subjects);
  options->limits.add_to(*command);
  options->separation.add_to(*command);
  command->add_option("--family", options->families, "Families of the random queries, separated by commas")
      ->delimiter(',')
      ->capture_default_str();
  command
      ->add_option("--kind", options->kinds,
                   "Kinds of the random queries, separated by commas; all that a family has by default")
      ->delimiter(',');
  add_count_option(
      *command, "--queries", options->queries, 1, std::uint64_t{1} << 32,
      "Number of random queries of each kind, which are asked together: a plug-in gets as many at "
      "once as it wants");
  add_count_option(*command, "--runs", options->runs, 1, 1'000'000, "Number of runs");
  command->add_flag("--judge", options->judge,
                    "Also judge the answers of the last run, on all cores; a miss gives exit code 1");
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
