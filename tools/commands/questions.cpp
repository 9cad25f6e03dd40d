// nearmiss distance and nearmiss step. These commands do not ask subjects whether primitives collide, but ask
// for distances and for safe parts of steps.
#include <fmt/format.h>

#include <memory>

#include "ccd/query/error.hpp"
#include "corpus/query_text.hpp"
#include "reports/text/json.hpp"
#include "reports/text/text.hpp"
#include "tools/arguments.hpp"
#include "tools/commands.hpp"
#include "tools/outputs.hpp"
#include "tools/question_results.hpp"
#include "tools/record.hpp"
#include "tools/terminal.hpp"

namespace nearmiss::tools {

namespace {

struct QuestionsOptions {
  std::vector<std::string> subjects, families{"all"}, kinds;
  std::string time, file;
  std::uint64_t cases = 0, seed = 1;
  int jobs = 1;
  bool quiet = false, no_search = false;
  PluginLimitOptions limits;
  JsonOutput json;
};

constexpr const char* usual_time = "20s";

/// The differences between the two commands: their texts, and whether a command asks queries of those
/// families in which the primitives are at rest.
struct Command {
  const char *name, *help;
  const char* function;   ///< the function of the plug-in interface that answers the question
  const char* of_file;    ///< what the command prints for each query of a file
  const char* exit_code;  ///< the line of --help that says when the exit code is 1
  bool asks_families_at_rest;
};

constexpr Command distance{
    "distance",
    "Hunt for wrong distances of primitives at rest, above all for those that are too large",
    "distance",
    "right, under-reported, over-reported, wrong-weights or fault; the distance that is given, or why there "
    "is "
    "none; and the subject",
    "a distance is over-reported, if weights are wrong",
    true};
constexpr Command step{
    "step",
    "Hunt for filtered steps that are not safe, and measure how much of a safe step is kept",
    "step",
    "right, unsafe or fault; the clearance and the places that are given, or why there are none; and the "
    "subject",
    "a filtered step is not safe",
    false};

std::set<Kind> kinds_of(const QuestionsOptions& options) {
  std::set<Kind> found;
  for (const std::string& each : options.kinds) found.insert(parse_kind(each, "--kind"));
  if (found.empty()) found.insert(kinds.begin(), kinds.end());
  return found;
}

/// Asks all subjects about the queries of a file, and prints a line for each query and subject.
template <class Question>
int ask_file(const QuestionsOptions& options, const Subjects& subjects) {
  if (options.kinds.size() != 1) throw Error("--kind: expected the one kind of the queries in the file");
  bool has_failed = false;
  bool was_asked = false;
  const QueryInput input{.kind = options.kinds.front(), .file = options.file, .separation = {}};
  input.read([&](const Query& query) {
    for (const auto& subject : subjects) {
      const auto judged = Question::ask(*subject, query);
      if (!judged) {
        fmt::print("not-asked - {}\n", subject->name());
        continue;
      }
      was_asked = true;
      has_failed = has_failed || judged->failure();
      const bool has_answer = judged->answer.fault == Fault::none;
      fmt::print("{} {} {}\n", judged->word(),
                 has_answer ? judged->answer_text() : Question::signature(*subject, *judged),
                 subject->name());
    }
  });
  return has_failed || !was_asked ? exit_found : exit_fine;
}

template <class Question>
int run(const QuestionsOptions& options, const Command& of) {
  const Stop at_signals(interrupted());
  isolation::PluginLimits limits = options.limits.limits();
  // A signal ends the wait for a plug-in's answer; the time limit of the command does not.
  limits.stop = &at_signals;
  const Subjects subjects = make_subjects(options.subjects, limits);
  QuestionPlan plan{.kinds = kinds_of(options),
                    .search = !options.no_search,
                    .cases = options.cases,
                    .seed = options.seed,
                    .jobs = options.jobs};
  for (const auto& subject : subjects)
    if (std::ranges::none_of(plan.kinds, [&](Kind kind) { return Question::is_answered(*subject, kind); }))
      throw Error(
          fmt::format("{}: found no function {}, expected a plug-in that has it for one of these kinds "
                      "(ccd/nearmiss_subject.h)",
                      subject->name(), of.function));
  if (!options.file.empty()) return ask_file<Question>(options, subjects);
  Stop stop(interrupted());
  plan.families = find_families(options.families, families_of_questions(of.asks_families_at_rest),
                                usual_families_of_questions(of.asks_families_at_rest), stop);
  for (const Family& family : plan.families)
    if (options.families != std::vector<std::string>{"all"} &&
        std::ranges::none_of(family.kinds, [&](Kind kind) { return plan.kinds.contains(kind); }))
      expect_kind(family, *plan.kinds.begin(), "--kind");
  options.json.expect_writable();
  std::string time = options.time;
  if (time.empty() && options.cases == 0) time = usual_time;
  if (!time.empty()) stop.limit(parse_duration(time, "--time"));
  stop_on_signals();
  QuestionResults<Question> results;
  {
    Progress progress(options.quiet);
    results = QuestionTrial<Question>(subjects, plan, stop).run([&](std::uint64_t asked) {
      if (progress.due()) progress.show(fmt::format("{} queries", with_separators(asked)));
    });
  }
  end_on_signals();
  fmt::print(options.json.text(), "{}", text_of(results));
  if (options.json.is_wanted()) {
    nlohmann::ordered_json json{{"run", run_info(of.name)}};
    json["run"]["seed"] = fmt::format("{}", options.seed);
    json.update(json_of(results));
    options.json.write(json);
  }
  if (stop.is_requested()) return exit_interrupted;
  return results.has_failed() ? exit_found : exit_fine;
}

template <class Question>
void add(CLI::App& app, int& exit_code, const Command& of) {
  auto options = std::make_shared<QuestionsOptions>();
  auto* command = app.add_subcommand(of.name, of.help);
  add_subject_option(*command, options->subjects);
  // Takes only one argument, because the argument after it may be FILE.
  command->get_option("--subject")->required()->allow_extra_args(false);
  auto* file = command->add_option(
      "FILE", options->file,
      fmt::format("Ask about the queries of a file instead, and print for each: {}", of.of_file));
  command
      ->add_option("--family", options->families,
                   "Families of queries, separated by commas; or all that are not extreme")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str()
      ->excludes(file)
      ->type_name("all|A,B@VALUE,...");
  command->add_option("--kind", options->kinds, "Kinds of queries, separated by commas; all by default")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember(short_names_of_kinds()))
      ->type_name("vt,ee,vv,ve");
  add_count_option(*command, "--cases", options->cases, 1, most_queries, "Number of queries, about")
      ->default_str("")
      ->excludes(file);
  command
      ->add_option(
          "--time", options->time,
          fmt::format("Time limit, such as 30s or 2m; none if --cases is given. Findings may be shrunk "
                      "for {} s more",
                      question_grace.count()))
      ->default_str(usual_time)
      ->excludes(file)
      ->type_name("T");
  command->add_flag("--no-search", options->no_search, "Leave out the directed search");
  add_seed_option(*command, options->seed);
  add_jobs_option(*command, options->jobs);
  options->limits.add_to(*command);
  options->json.add_to(*command, "Write the results as JSON");
  command->get_option("--json")->excludes(file);
  command->add_flag("-q,--quiet", options->quiet, "Show no progress");
  command->footer(
      fmt::format("\nThe exit code is 1 if {}, or if an answer is missing, for a query that is not extreme; "
                  "or if nothing was "
                  "asked.",
                  of.exit_code));
  command->callback([options, &exit_code, &of] { exit_code = run<Question>(*options, of); });
}

}  // namespace

void add_distance(CLI::App& app, int& exit_code) { add<DistanceQuestion>(app, exit_code, distance); }
void add_step(CLI::App& app, int& exit_code) { add<StepQuestion>(app, exit_code, step); }

}  // namespace nearmiss::tools
