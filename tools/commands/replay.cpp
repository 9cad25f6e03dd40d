// nearmiss replay: lets subjects decide recorded cases.
#include <fmt/format.h>

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "ccd/query/error.hpp"
#include "ccd/query/printable.hpp"
#include "corpus/readers.hpp"
#include "fuzz/subjects/recorded.hpp"
#include "fuzz/trial/trial_stream.hpp"
#include "reports/text/shell.hpp"
#include "reports/text/text.hpp"
#include "tools/arguments.hpp"
#include "tools/commands.hpp"
#include "tools/one_case.hpp"
#include "tools/record.hpp"
#include "tools/terminal.hpp"
#include "tools/trial_options.hpp"

namespace nearmiss::tools {

namespace {

namespace fs = std::filesystem;

struct ReplayOptions {
  std::vector<fs::path> paths;
  TrialOptions trial;
  std::string bound;
  SeparationOption separation;
  RecordOptions record;
  bool as_answered = false;
};

/// The family under which a case is counted: "NAME/", where NAME is the folder of the case. If that folder is
/// called edge-edge or vertex-face, NAME is the folder above it.
std::string family_of(const std::string& name) {
  fs::path folder = fs::absolute(name).lexically_normal().parent_path();
  if (folder.filename() == "edge-edge" || folder.filename() == "vertex-face") folder = folder.parent_path();
  return printable(folder.filename().string()) + "/";
}

/// Says on stderr how many records of a recording are left out, and why.
void say(const fs::path& path, const LeftOut& left) {
  const auto line = [&](std::uint64_t count, std::string_view why) {
    if (count > 0)
      fmt::print(stderr, "nearmiss: {}: {} left out: {}\n", printable(path.string()),
                 counted(count, "record", "records"), why);
  };
  line(left.unused.unfinished, "they were being written when the program or the file ended");
  line(
      left.unused.not_queries,
      "they have numbers or kinds that no query has, such as infinity, a tmax of 0 or a negative separation");
  line(left.rounded, "their tmax is not 1, and doubles do not hold what was asked");
}

/// Some subjects, and the cases that they decide.
struct Pass {
  Subjects subjects;
  std::function<void(const CaseSink&)> read;
};

/// The passes that judge the answers in recordings, and ask no subject. If a query has several different
/// answers in the recordings, these answers are in different passes.
std::vector<Pass> passes_as_answered(const ReplayOptions& options, std::set<Kind>& seen) {
  std::vector<RecordedAnswer> answers;
  for (const fs::path& path : options.paths) {
    const std::size_t before = answers.size();
    say(path, read_judgeable(path, [&](RecordedAnswer&& each) {
          seen.insert(each.query.kind);
          answers.push_back(std::move(each));
        }));
    if (answers.size() == before)
      throw Error(fmt::format("{}: found no record that can be judged, expected some", path.string()));
  }
  std::vector<Pass> passes;
  for (RecordedPass& each : in_passes(std::move(answers))) {
    Pass& pass = passes.emplace_back();
    pass.subjects.push_back(std::move(each.subject));
    pass.read = [recorded = std::move(each.answers)](const CaseSink& sink) {
      for (const RecordedAnswer& answer : recorded)
        sink({.name = fmt::format("{}:{}", answer.file.string(), answer.number), .query = answer.query});
    };
  }
  return passes;
}

/// The pass that asks the subjects about the cases in files and folders.
Pass pass_of_cases(const ReplayOptions& options, std::set<Kind>& seen, const Stop& stop) {
  Pass pass;
  pass.subjects = options.trial.make_subjects(stop, parse_bound(options.bound));
  // Reads all case files once, so that the command refuses a bad case before it writes a file.
  for (const fs::path& path : options.paths)
    read_cases(path, [&](const Case& each) { seen.insert(each.query.kind); });
  pass.read = [&options](const CaseSink& sink) {
    for (const fs::path& path : options.paths) read_cases(path, sink);
  };
  return pass;
}

struct Replayed {
  std::uint64_t cases = 0;
  Query last = {};
  /// For each kind, the number of its cases that have a separation.
  std::map<Kind, std::uint64_t> with_separation = {};
};

/// Lets the subjects of a pass decide the pass's cases, and adds the results to `record`.
void hold(const ReplayOptions& options, const Pass& pass, const Stop& stop, Record& record,
          Progress& progress, Replayed& replayed) {
  const bool shrinks = !options.trial.no_shrink && !options.as_answered;
  Trials trials(pass.subjects, options.trial.comparison, options.trial.jobs, stop, shrinks,
                [&](TrialResult&& result) { record.add(std::move(result)); });
  TrialStream stream(trials);
  const auto add = [&](const Case& each) {
    stop.check();
    // If --separation changes the query, the case's recorded truth does not hold for the changed query.
    const Query query = options.separation.apply(each.query);
    stream.add(family_of(each.name), query, query == each.query ? each.truth : std::nullopt,
               [name = each.name] { return printable(name); });
    ++replayed.cases;
    replayed.last = query;
    replayed.with_separation[query.kind] += query.separation > 0 ? 1 : 0;
    if (progress.due())
      progress.show(fmt::format("{} cases, {} false negatives", with_separators(replayed.cases),
                                with_separators(record.statistics().false_negatives())));
  };
  try {
    pass.read(add);
  } catch (const Stopped&) {  // the command still reports the results of the cases before the stop
  }
  stream.finish();
  trials.finish([&] {
    if (progress.due()) progress.show(shrinking_line(trials.to_shrink()));
  });
}

/// Says which subjects were not asked about cases with separations, because they answer for contact only.
void print_unasked(const Subjects& subjects, const Replayed& replayed, std::FILE* out) {
  for (const auto& subject : subjects) {
    std::uint64_t not_asked = 0;
    for (const auto& [kind, cases] : replayed.with_separation)
      if (subject->decides(kind) && !subject->takes_separation(kind)) not_asked += cases;
    if (not_asked > 0)
      fmt::print(out, "{}: not asked about {}, because it answers for contact only\n", subject->name(),
                 counted(not_asked, "case with a separation", "cases with a separation"));
  }
}

OneCase one_case(const ReplayOptions& options, const Query& query) {
  OneCase one{query, {}, {}};
  if (options.paths.size() == 1 && fs::is_regular_file(options.paths.front()))
    one.file = options.paths.front().string();
  if (options.separation.is_given()) one.options += " --separation " + shell_quoted(options.separation.text);
  if (options.trial.limits.time != PluginLimitOptions().time)
    one.options += " --query-time " + options.trial.limits.time;
  return one;
}

/// The facts on which the results depend, and the command that repeats the run.
RunInfo info_of(const ReplayOptions& options, const Subjects& subjects) {
  std::string command = "replay";
  for (const fs::path& path : options.paths) command += " " + printable_argument(path.string());
  RunInfo info = options.trial.run_info(command, subjects);
  if (options.as_answered) info["again"] = "nearmiss " + command + " --as-answered";
  if (!options.bound.empty()) note_option(info, "bound", "--bound", options.bound);
  if (options.trial.comparison.certify_truths) {
    info["certified"] = "the recorded truths";
    info["again"] += " --certify";
  }
  if (options.separation.is_given()) note_option(info, "separation", "--separation", options.separation.text);
  return info;
}

int run(const ReplayOptions& options) {
  const Stop stop(interrupted());
  std::set<Kind> seen;
  std::vector<Pass> passes;
  if (options.as_answered)
    passes = passes_as_answered(options, seen);
  else
    passes.push_back(pass_of_cases(options, seen, stop));
  const Subjects& subjects = passes.front().subjects;
  if (options.separation.apply({}).separation > 0)
    expect_separations(subjects, std::vector(seen.begin(), seen.end()));
  Record record(options.record, info_of(options, subjects), {.environment = plugin_environment(subjects)});
  Replayed replayed;
  {
    Progress progress(options.record.quiet);
    for (const Pass& pass : passes) hold(options, pass, stop, record, progress, replayed);
  }
  print_unasked(subjects, replayed, options.record.json.text());
  if (!stop.is_requested()) record.add_unasked(subjects);
  std::function<std::string(const Campaign&)> describe_one;
  if (replayed.cases == 1 && !options.as_answered && !stop.is_requested())
    describe_one = [&](const Campaign& campaign) {
      return describe(one_case(options, replayed.last), campaign, subjects,
                      options.record.fail_on.failures());
    };
  return record.finish(stop.is_requested(), !stop.is_requested(), describe_one);
}

}  // namespace

void add_replay(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ReplayOptions>();
  auto* command =
      app.add_subcommand("replay", "Let subjects and the oracle decide the cases in files and folders");
  command
      ->add_option("PATH", options->paths,
                   "*.case, *.csv, *.nmq, *.vt, *.ee, *.vv and *.ve files, or folders of them")
      ->required();
  auto* as_answered = command->add_flag(
      "--as-answered", options->as_answered,
      "Judge the answers in recordings (nearmiss_record.h), *.nmq, under the name 'recorded', without a CCD");
  options->trial.add_to(*command);
  as_answered->excludes("--subject");
  add_bound_option(*command, options->bound);
  as_answered->excludes(options->separation.add_to(*command));
  command->add_flag(
      "--certify", options->trial.comparison.certify_truths,
      "Demand a certificate of each recorded truth, which the checker of tools/certificates/ accepts; "
      "a truth without one counts as an oracle disagreement. A smallest distance of exactly the separation "
      "is proved up to the doubles next to it");
  options->record.add_to(*command);
  command->footer("\nExample: nearmiss replay corpus --subject basic,wang");
  command->callback([options, &exit_code] {
    if (options->as_answered) options->trial.subjects = {std::string(recorded_name)};
    exit_code = run(*options);
  });
}

}  // namespace nearmiss::tools
