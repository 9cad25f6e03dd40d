// nearmiss replay: lets subjects decide recorded cases.
#include <fmt/format.h>

#include <map>
#include <set>
#include <vector>

#include "ccd/query/printable.hpp"
#include "corpus/readers.hpp"
#include "fuzz/trial/trial_stream.hpp"
#include "reports/text/shell.hpp"
#include "reports/text/text.hpp"
#include "tools/arguments.hpp"
#include "tools/commands.hpp"
#include "tools/record.hpp"
#include "tools/terminal.hpp"
#include "tools/trial_options.hpp"

namespace nearmiss::tools {

namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<fs::path> paths;
  TrialOptions trial;
  std::string bound;
  SeparationOption separation;
  RecordOptions record;
};

/// The family under which a case is counted: the name of its folder, "NAME/". If that folder is edge-edge or
/// vertex-face, the folder above it counts.
std::string family_of(const std::string& name) {
  fs::path folder = fs::absolute(name).lexically_normal().parent_path();
  if (folder.filename() == "edge-edge" || folder.filename() == "vertex-face") folder = folder.parent_path();
  return printable(folder.filename().string()) + "/";
}

int run(const Options& options) {
  const Stop stop(interrupted());
  const Subjects subjects = options.trial.make_subjects(stop, parse_bound(options.bound));
  std::set<Kind> seen;
  for (const fs::path& path : options.paths)  // checks all files before anything is written
    read_cases(path, [&](const Case& each) { seen.insert(each.query.kind); });
  if (options.separation.apply({}).separation > 0)
    expect_separations(subjects, std::vector(seen.begin(), seen.end()));
  std::string command = "replay";
  for (const fs::path& path : options.paths) command += " " + printable_argument(path.string());
  RunInfo info = options.trial.run_info(command, subjects);
  if (!options.bound.empty()) note_option(info, "bound", "--bound", options.bound);
  if (options.trial.comparison.certify_truths) {
    info["certified"] = "the recorded truths";
    info["again"] += " --certify";
  }
  if (options.separation.is_given()) note_option(info, "separation", "--separation", options.separation.text);
  Record record(options.record, std::move(info), {.environment = plugin_environment(subjects)});
  std::map<Kind, std::uint64_t> with_separation;
  {
    Progress progress(options.record.quiet);
    std::uint64_t count = 0;
    Trials trials(subjects, options.trial.comparison, options.trial.jobs, stop, !options.trial.no_shrink,
                  [&](TrialResult&& result) { record.add(std::move(result)); });
    TrialStream stream(trials);
    const auto add = [&](const Case& each) {
      stop.check();
      // A recorded truth does not hold for another separation.
      const Query query = options.separation.apply(each.query);
      stream.add(family_of(each.name), query, query == each.query ? each.truth : std::nullopt,
                 [name = each.name] { return printable(name); });
      ++count;
      with_separation[query.kind] += query.separation > 0 ? 1 : 0;
      if (progress.due())
        progress.show(fmt::format("{} cases, {} false negatives", with_separators(count),
                                  with_separators(record.statistics().false_negatives())));
    };
    try {
      for (const fs::path& path : options.paths) read_cases(path, add);
    } catch (const Stopped&) {  // the results so far are still reported
    }
    stream.finish();
    trials.finish([&] {
      if (progress.due()) progress.show(shrinking_line(trials.to_shrink()));
    });
  }
  for (const auto& subject : subjects) {
    std::uint64_t not_asked = 0;
    for (const auto& [kind, cases] : with_separation)
      if (subject->decides(kind) && !subject->takes_separation(kind)) not_asked += cases;
    if (not_asked > 0)
      fmt::print(options.record.json.text(), "{}: not asked about {}, because it answers for contact only\n",
                 subject->name(), counted(not_asked, "case with a separation", "cases with a separation"));
  }
  if (!stop.is_requested()) record.add_unasked(subjects);
  return record.finish(stop.is_requested(), !stop.is_requested());
}

}  // namespace

void add_replay(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<Options>();
  auto* command =
      app.add_subcommand("replay", "Let subjects and the oracle decide the cases in files and folders");
  command
      ->add_option("PATH", options->paths,
                   "*.case, *.csv, *.vt, *.ee, *.vv and *.ve files, or folders of them")
      ->required();
  options->trial.add_to(*command);
  add_bound_option(*command, options->bound);
  options->separation.add_to(*command);
  command->add_flag(
      "--certify", options->trial.comparison.certify_truths,
      "Demand a certificate of each recorded truth, which the checker of tools/certificates/ accepts; "
      "a truth without one counts as an oracle disagreement. A smallest distance of exactly the separation "
      "is proved up to the doubles next to it");
  options->record.add_to(*command);
  command->footer("\nExample: nearmiss replay corpus --subject basic,wang");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace nearmiss::tools
