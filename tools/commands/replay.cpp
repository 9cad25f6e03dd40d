// nearmiss replay: lets subjects decide recorded cases.
#include <fmt/format.h>

#include <functional>
#include <map>
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
  bool as_answered = false;
};

/// The family under which a case is counted: the name of its folder, "NAME/". If that folder is edge-edge or
/// vertex-face, the folder above it counts.
std::string family_of(const std::string& name) {
  fs::path folder = fs::absolute(name).lexically_normal().parent_path();
  if (folder.filename() == "edge-edge" || folder.filename() == "vertex-face") folder = folder.parent_path();
  return printable(folder.filename().string()) + "/";
}

/// What is replayed: the cases of files and folders, or the answers of recordings.
class Replayed {
 public:
  explicit Replayed(const Options& options) : options_(options) {
    for (const fs::path& path : options.paths)  // reads all files before anything is written
      if (options.as_answered)
        add_recording(path);
      else
        read_cases(path, [&](const Case& each) { kinds_.insert(each.query.kind); });
  }

  /// The kinds of the cases.
  [[nodiscard]] const std::set<Kind>& kinds() const { return kinds_; }

  [[nodiscard]] Subjects subjects(const Stop& stop) const {
    if (!options_.as_answered) return options_.trial.make_subjects(stop, parse_bound(options_.bound));
    Subjects subjects;
    subjects.push_back(recorded_answers(answers_));
    return subjects;
  }

  void read(const std::function<void(const Case&)>& sink) const {
    for (const auto& [path, count] : recordings_) {
      for (std::size_t i = 0; i < count.second; ++i) {
        const RecordedAnswer& each = answers_[count.first + i];
        sink({.name = fmt::format("{}:{}", path.string(), each.number), .query = each.query});
      }
    }
    if (options_.as_answered) return;
    for (const fs::path& path : options_.paths) read_cases(path, sink);
  }

 private:
  void add_recording(const fs::path& path) {
    const std::size_t first = answers_.size();
    const LeftOut left = read_judgeable(path, [&](RecordedAnswer&& each) {
      kinds_.insert(each.query.kind);
      answers_.push_back(std::move(each));
    });
    recordings_.emplace_back(path, std::pair(first, answers_.size() - first));
    const auto say = [&](std::uint64_t count, std::string_view why) {
      if (count > 0)
        fmt::print(stderr, "nearmiss: {}: {} left out: {}\n", printable(path.string()),
                   counted(count, "record", "records"), why);
    };
    say(left.unused.unfinished, "they were being written when the program or the file ended");
    say(left.unused.not_finite, "they have numbers that no query has, such as infinity");
    say(left.rounded, "their tmax is not 1, and doubles do not hold what was asked");
    if (answers_.size() == first)
      throw Error(fmt::format("{}: found no record that can be judged, expected some", path.string()));
  }

  const Options& options_;
  std::set<Kind> kinds_;
  std::vector<RecordedAnswer> answers_;
  std::vector<std::pair<fs::path, std::pair<std::size_t, std::size_t>>>
      recordings_;  // first answer, and count
};

int run(const Options& options) {
  const Stop stop(interrupted());
  const Replayed replayed(options);
  const Subjects subjects = replayed.subjects(stop);
  const std::set<Kind>& seen = replayed.kinds();
  if (options.separation.apply({}).separation > 0)
    expect_separations(subjects, std::vector(seen.begin(), seen.end()));
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
  Record record(options.record, std::move(info), {.environment = plugin_environment(subjects)});
  std::map<Kind, std::uint64_t> with_separation;
  {
    Progress progress(options.record.quiet);
    std::uint64_t count = 0;
    const bool shrinks = !options.trial.no_shrink && !options.as_answered;
    Trials trials(subjects, options.trial.comparison, options.trial.jobs, stop, shrinks,
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
      replayed.read(add);
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
                   "*.case, *.csv, *.nmq, *.vt, *.ee, *.vv and *.ve files, or folders of them")
      ->required();
  auto* as_answered = command->add_flag(
      "--as-answered", options->as_answered,
      "Judge the answers in recordings (nearmiss_record.h), *.nmq, under the name 'recorded', without a CCD");
  options->trial.add_to(*command);
  as_answered->excludes("--subject");
  add_bound_option(*command, options->bound);
  options->separation.add_to(*command);
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
