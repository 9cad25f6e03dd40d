// nearmiss power: measures how soon each way to hunt finds each known defect.
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <map>
#include <sstream>
#include <string_view>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "ccd/query/printable.hpp"
#include "fuzz/libfuzzer/targets.hpp"
#include "fuzz/search/search.hpp"
#include "fuzz/studies/power.hpp"
#include "fuzz/subjects/contracted.hpp"
#include "fuzz/subjects/defects.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "reports/sections/other_tables.hpp"
#include "reports/text/json.hpp"
#include "reports/text/shell.hpp"
#include "reports/text/text.hpp"
#include "tools/arguments.hpp"
#include "tools/commands.hpp"
#include "tools/outputs.hpp"
#include "tools/terminal.hpp"

namespace nearmiss::tools {

namespace {

struct PowerOptions {
  std::vector<std::string> subjects;
  std::vector<std::string> ways;
  std::string time = "60s", libfuzzer;
  JsonOutput json;
  std::uint64_t seed = 1;
  int jobs = 1;
};

constexpr std::string_view uniform = "uniform";
constexpr std::string_view all_families = "families";
constexpr std::string_view search = "search";
constexpr std::string_view coverage_guided = "libfuzzer";

Hunt hunt(const PowerOptions& options, const std::string& subject, const std::string& way) {
  Stop stop(interrupted());
  Subjects subjects;
  subjects.push_back(std::move(keep_contract(make_any_subject(subject), false).front()));
  CampaignPlan plan;
  const Subject& defect = *subjects.front();
  if (way == uniform)
    plan.families =
        families_for(defect, std::array{find_family("uniform")}, std::array{find_family("v-uniform")});
  if (way == all_families) plan.families = families_for(defect, families(), vertex_families());
  if (way == all_families && defect.takes_separation(Kind::vertex_triangle))
    plan.families.insert(plan.families.end(), separation_families().begin(), separation_families().end());
  if (way == search) plan.families = searches(defect, stop);
  if (way == search && defect.takes_separation(Kind::vertex_triangle)) {
    auto separated = searches(defect, stop, drawn_separation);
    std::move(separated.begin(), separated.end(), std::back_inserter(plan.families));
  }
  plan.seed = options.seed;
  plan.shrink = false;
  plan.jobs = options.jobs;
  stop.limit(parse_duration(options.time, "--time"));
  Hunt result{.subject = subject, .way = way};
  if (const auto first = find_first_failure(plan, subjects, stop)) {
    result.failure = name(first->finding.what);
    result.seconds = first->seconds;
    result.cases = first->cases * (way == search ? search_evaluations : 1);
    result.provenance = first->finding.provenance;
  }
  return result;
}

/// Runs a command in the shell, and returns the end of its output. A signal that ends nearmiss also ends the
/// command: by SIGTERM, and after a second by SIGKILL.
std::string output_of(const std::string& command) {
  constexpr std::size_t most_bytes = 1 << 16;
  std::array<int, 2> pipe{};
  const pid_t process = pipe2(pipe.data(), O_CLOEXEC) == 0 ? fork() : -1;
  if (process < 0) throw Error(fmt::format("'{}': cannot be run", command));
  if (process == 0) {
    setpgid(0, 0);
    dup2(pipe[1], STDOUT_FILENO);
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(exit_bad_input);
  }
  setpgid(process, process);  // the child sets its process group, too, in case it runs before its parent
  close(pipe[1]);
  std::string text;
  std::vector<char> buffer(most_bytes);
  bool has_ended = false;
  bool is_open = true;
  // The command may leave a process behind that keeps the pipe open and writes to the pipe without end.
  constexpr int most_reads_after_the_end = 64;
  int reads_after_the_end = 0;
  auto kill_at = std::chrono::steady_clock::time_point::max();
  while (!has_ended || is_open) {
    constexpr int patience_ms = 100;
    pollfd readable{.fd = is_open ? pipe[0] : -1, .events = POLLIN, .revents = 0};
    const bool has_more = poll(&readable, 1, patience_ms) > 0;
    if (interrupted()) {
      const auto now = std::chrono::steady_clock::now();
      kill_at = std::min(kill_at, now + std::chrono::seconds(1));
      // Also signals the process itself, because it may have left its process group.
      for (const pid_t each : {-process, process})
        if (!has_ended) kill(each, now < kill_at ? SIGTERM : SIGKILL);
      if (now > kill_at + std::chrono::milliseconds(500)) break;
    }
    if (has_more) {
      const ssize_t n = read(pipe[0], buffer.data(), buffer.size());
      if (n > 0) text.append(buffer.data(), static_cast<std::size_t>(n));
      if (text.size() > 2 * most_bytes) text.erase(0, text.size() - most_bytes);
      is_open = n != 0;
    }
    if (has_ended && (!has_more || ++reads_after_the_end > most_reads_after_the_end)) break;
    if (!has_ended) has_ended = waitpid(process, nullptr, WNOHANG) == process;
  }
  if (interrupted()) kill(-process, SIGKILL);  // ends the command's processes that ignored SIGTERM
  close(pipe[0]);
  return text;
}

/// Removes a number, and the text `then` after it, from the beginning of a text. Returns false if the number
/// or `then` is missing.
template <class Number>
bool take(std::string_view& text, Number& number, std::string_view then) {
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
  if (error != std::errc() || !text.starts_with(then)) return false;
  text.remove_prefix(then.size());
  return true;
}

/// Hunts with one libFuzzer target. Runs the command of --libfuzzer with the target, and looks in the
/// command's output for a line "found after S s, N executions: PATH" or "nothing in ...".
Hunt hunt_with_target(const PowerOptions& options, const std::string& subject,
                      const libfuzzer::PromiseTarget& target, int seconds) {
  const std::string command = fmt::format("{} --first {} {}s {}", options.libfuzzer, target.name, seconds,
                                          printable_argument(subject));
  std::istringstream output(output_of(command));
  Hunt result{.subject = subject, .way = std::string(coverage_guided)};
  bool is_known = interrupted();
  std::string last;
  for (std::string line; std::getline(output, line); last = line) {
    constexpr std::string_view found = "found after ";
    std::string_view rest = line;
    if (line.starts_with("nothing in")) is_known = true;
    if (!line.starts_with(found)) continue;
    rest.remove_prefix(found.size());
    if (!take(rest, result.seconds, " s, ") || !take(rest, result.cases, " executions: ")) continue;
    if (!std::isfinite(result.seconds) || result.seconds < 0) continue;
    result.failure = name(target.finds);
    result.provenance = printable(rest);
    return result;
  }
  if (!is_known)
    throw Error(fmt::format("'{}': printed '{}', expected 'found after ...' or 'nothing in ...'", command,
                            excerpt(last, 200)));
  return result;
}

/// Hunts with each libFuzzer target of the subject for an equal share of the time. Returns the hunt that
/// found a failure soonest.
Hunt hunt_with_libfuzzer(const PowerOptions& options, const std::string& subject) {
  const auto targets = libfuzzer::targets_for(*make_any_subject(subject));
  const double share = parse_duration(options.time, "--time").count() / static_cast<double>(targets.size());
  const int seconds = std::max(1, static_cast<int>(share));
  Hunt soonest{.subject = subject, .way = std::string(coverage_guided)};
  for (const libfuzzer::PromiseTarget& target : targets) {
    if (interrupted()) break;
    Hunt hunt = hunt_with_target(options, subject, target, seconds);
    if (hunt.failure && (!soonest.failure || hunt.seconds < soonest.seconds)) soonest = std::move(hunt);
  }
  return soonest;
}

/// The time that a hunt took, and the number of cases that it decided, until it found a failure:
/// "0.12 s  12,345". If the failure is a late time, "+" follows these numbers; if it is a refuted bound, "*"
/// follows. A miss has no mark. If the hunt found no failure, returns "-".
std::string cell(const Hunt& hunt) {
  if (!hunt.failure) return "-";
  const std::string_view mark = *hunt.failure == name(Finding::What::refuted_bound) ? "*"
                                : *hunt.failure == name(Finding::What::late)        ? "+"
                                                                                    : "";
  return fmt::format("{:.2f} s {:>12}{}", hunt.seconds, with_separators(hunt.cases), mark);
}

std::string table(const std::vector<Hunt>& results, const std::vector<std::string>& ways) {
  std::string text = fmt::format("{:<24}", "defect");
  for (const std::string& way : ways) text += fmt::format(" {:>22}", way);
  text += "\n";
  std::vector<std::string> subjects;
  std::map<std::pair<std::string, std::string>, std::string> cells;
  std::map<std::string, int> found;
  for (const Hunt& hunt : results) {
    if (std::find(subjects.begin(), subjects.end(), hunt.subject) == subjects.end())
      subjects.push_back(hunt.subject);
    cells[{hunt.subject, hunt.way}] = cell(hunt);
    found[hunt.way] += hunt.failure ? 1 : 0;
  }
  for (const std::string& subject : subjects) {
    text += fmt::format("{:<24}", subject);
    for (const std::string& way : ways) text += fmt::format(" {:>22}", cells[{subject, way}]);
    text += "\n";
  }
  text += fmt::format("{:<24}", fmt::format("found, of {}", subjects.size()));
  for (const std::string& way : ways) text += fmt::format(" {:>22}", found[way]);
  return text +
         "\n\nTime and cases up to the first miss; *: up to the first refuted bound; +: up to the first late "
         "time. For directed search, the number of cases is an upper limit of the evaluations. For "
         "libFuzzer, time and cases are those of the target that found a failure soonest.\n";
}

int run(const PowerOptions& options) {
  (void)parse_duration(options.time, "--time");  // refuses a bad --time before the command does any work
  std::vector<Hunt> results;
  const std::filesystem::path stored = options.json.file();
  if (!stored.empty() && std::filesystem::exists(stored)) results = load_hunts(stored);
  std::vector<std::string> subjects = options.subjects;
  if (subjects.empty())
    for (const Defect& defect : defects()) subjects.push_back(defect.name);
  for (const std::string& subject : subjects) (void)make_any_subject(subject);  // refuses unknown subjects
  std::vector<std::string> ways = options.ways;
  if (ways.empty()) {
    ways = {std::string(uniform), std::string(all_families), std::string(search)};
    if (!options.libfuzzer.empty()) ways.emplace_back(coverage_guided);
  }
  for (const Hunt& each : results)
    if (each.time != options.time || each.seed != options.seed)
      throw Error(fmt::format("{}: found hunts with --time {} --seed {}, expected {} and {}, or another file",
                              stored.string(), each.time, each.seed, options.time, options.seed));
  const auto is_done = [&](const std::string& subject, const std::string& way) {
    return std::any_of(results.begin(), results.end(),
                       [&](const Hunt& each) { return each.subject == subject && each.way == way; });
  };
  stop_on_signals();
  Progress progress;
  for (const std::string& subject : subjects) {
    for (const std::string& way : ways) {
      if (interrupted() || is_done(subject, way)) continue;
      progress.show(fmt::format("{}: {}", subject, way));
      auto result =
          way == coverage_guided ? hunt_with_libfuzzer(options, subject) : hunt(options, subject, way);
      if (interrupted()) continue;
      result.time = options.time;
      result.seed = options.seed;
      results.push_back(std::move(result));
      if (!stored.empty()) options.json.write(hunts_json(results));
    }
  }
  end_on_signals();
  if (options.json.is_stdout()) options.json.write(hunts_json(results));
  fmt::print(options.json.text(), "{}", table(results, ways));
  return interrupted() ? exit_interrupted : exit_fine;
}

}  // namespace

void add_power(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<PowerOptions>();
  auto* command = app.add_subcommand("power", "Measure how soon each way to hunt finds each known defect");
  command->add_option("--subject", options->subjects, "Defects, separated by commas; all by default")
      ->delimiter(',')
      ->type_name("defect:A,...");
  command->add_option("--way", options->ways, "Ways to hunt, separated by commas; all by default")
      ->delimiter(',')
      ->check(CLI::IsMember({std::string(uniform), std::string(all_families), std::string(search),
                             std::string(coverage_guided)}));
  command->add_option("--time", options->time, "Time limit for each defect and way: 10s, 2m")
      ->capture_default_str()
      ->type_name("T");
  command
      ->add_option("--libfuzzer", options->libfuzzer,
                   "Also hunt with this command, tools/libfuzzer, whose targets share the time")
      ->type_name("COMMAND");
  options->json.add_to(*command, "Store the measurements in this file, and skip those that it already has");
  command->add_option("--seed", options->seed, "Seed; queries are a pure function of family, seed and index")
      ->capture_default_str()
      ->type_name("S");
  add_jobs_option(*command, options->jobs);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace nearmiss::tools
