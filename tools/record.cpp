#include "tools/record.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <sstream>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "corpus/query_text.hpp"
#include "fuzz/stop.hpp"
#include "fuzz/trial/so_far.hpp"
#include "oracle/explanation.hpp"
#include "reports/campaign/finding_case.hpp"
#include "reports/report.hpp"
#include "reports/sections/sections.hpp"
#include "reports/text/json.hpp"
#include "reports/text/shell.hpp"
#include "reports/text/text.hpp"
#include "tools/arguments.hpp"
#include "tools/commands.hpp"
#include "tools/commit.hpp"
#include "tools/terminal.hpp"

namespace nearmiss::tools {

namespace {

constexpr std::size_t printed_if_verbose = 10;  // findings
constexpr auto save_interval = std::chrono::milliseconds(500);
// This interval is long, because each attempt to save waits for the lock of the store.
constexpr auto when_locked = std::chrono::seconds(5);
// This interval is long, because a save of shrunk findings writes all findings.
constexpr auto save_shrunk_interval = std::chrono::seconds(5);

std::string cpu_model() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(std::min(line.find(": ") + 2, line.size()));
  return "unknown";
}

/// Prints what failed, the simplest query that fails in the same way, and an explanation of this query.
void print(std::FILE* text, const Finding& finding, std::uint64_t seen) {
  fmt::print(text, "  {} {} {} ({} query{}; {}, {} in all)\n", name(finding.what), finding.subject,
             finding.provenance, name(finding.query_class), finding.is_shrunk ? "" : ", not shrunk",
             finding.signature, seen_text(seen));
  std::istringstream lines(to_readable(finding.shrunk));
  for (std::string line; std::getline(lines, line);) fmt::print(text, "    {}\n", line);
  fmt::print(text, "    {}\n", to_text(explain(finding.shrunk)));
  constexpr std::size_t most_lines = 4;
  for (const std::string& line : stderr_lines(finding, most_lines)) fmt::print(text, "    {}\n", line);
}

/// Prints one query for each version that breaks queries: the first query that the version breaks.
void print_broken(std::FILE* text, const std::vector<Finding>& findings, const Statistics& statistics) {
  std::set<std::string> printed;
  for (const Finding& each : findings) {
    if (each.broken_since.empty() || !printed.insert(each.subject).second) continue;
    fmt::print(text, "\n{} answers rightly, and {} does not:\n", each.broken_since, each.subject);
    print(text, each, statistics.times_seen(signature_of(each)));
  }
}

std::string shown_lines(std::FILE* text, const std::string& lines) {
  constexpr std::size_t columns = 100, most_lines = 6;
  if (isatty(fileno(text)) == 0) return lines;
  std::string all;
  std::istringstream from(lines);
  for (std::string line; std::getline(from, line);) all += wrapped(line, "     ", most_lines, columns);
  return all;
}

/// Calls `save`. If another process has locked the store, tries again for half a minute.
template <class Save>
void patiently(const Save& save) {
  for (int tries_left = 20;; --tries_left) {
    try {
      return save();
    } catch (const StoreIsLocked&) {
      if (tries_left == 0) throw;
    }
  }
}

}  // namespace

void RecordOptions::add_to(CLI::App& command) {
  json.add_to(command, "Write the statistics as JSON");
  command
      .add_option("--db", db, "Save statistics and findings in this new store, for nearmiss report and merge")
      ->type_name("FILE");
  fail_on.add_to(command);
  ci.add_to(command);
  command.add_flag("-q,--quiet", quiet, "Show no progress");
  add_verbose_option(command, verbose);
}

std::vector<std::string> stderr_lines(const Finding& finding, std::size_t most) {
  constexpr std::size_t most_bytes = 85, most_calls = 2;
  std::vector<std::string> messages, calls;
  for (const std::string& line : error_lines(finding)) {
    const std::size_t first = line.find_first_not_of(' ');
    if (first == line.npos) continue;
    const bool is_call = line.find("+0x") != line.npos && line.ends_with(')');
    if (is_call && (line.find("/libc.so") != line.npos || calls.size() == most_calls)) continue;
    (is_call ? calls : messages)
        .push_back("stderr: " + excerpt(std::string_view(line).substr(first), most_bytes));
  }
  calls.resize(std::min(calls.size(), most));
  const std::size_t shown = std::min(messages.size(), most - calls.size());
  messages.erase(messages.begin(), messages.end() - static_cast<std::ptrdiff_t>(shown));
  messages.insert(messages.end(), calls.begin(), calls.end());
  return messages;
}

RunInfo environment() {
  return {{"compiler", NEARMISS_COMPILER}, {"flags", NEARMISS_FLAGS}, {"cpu", cpu_model()}};
}

RunInfo run_info(const std::string& command) {
  return {{"command", command}, {"version", NEARMISS_VERSION}, {"commit", commit()}};
}

Record::Record(RecordOptions options, RunInfo info, const Shard& shard)
    : options_(std::move(options)), info_(std::move(info)), shard_(shard) {
  stop_on_signals();
  options_.json.expect_writable(options_.db);
  options_.ci.expect_writable(
      std::array{OptionFile{options_.db, "--db"}, OptionFile{options_.json.file(), "--json"}});
  shard_.started = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  shard_.environment.merge(environment());
  if (options_.resume && Store::exists(options_.db))
    go_on();
  else if (!options_.db.empty())
    begin();
}

Record::~Record() {
  if (!store_) return;
  try {
    if (unsaved_) save_now();
  } catch (const std::exception&) {
    // The cause of this exception, such as a full disk, has already ended the command.
  }
  if (saved_) return;
  store_.reset();
  Store::remove(options_.db);
}

/// Makes the store. Throws Error if it exists.
void Record::begin() {
  if (options_.can_resume && Store::exists(options_.db))
    throw Error(
        fmt::format("{}: exists already, expected a new file, or --resume to continue the campaign in it",
                    options_.db.string()));
  store_.emplace(options_.db, info_, shard_);
}

/// Loads the run that the store holds, so that this run continues it. Throws Error if the store has another
/// run, and Stopped if the user ends the command.
void Record::go_on() {
  Campaign before;
  store_.emplace(options_.db, &before, [] { Stop(interrupted()).check(); });
  saved_ = true;
  Run& run = before.runs.at(0);
  const auto expect = [&](const std::string& what, const std::string& found, const std::string& expected) {
    const auto quoted = [](const std::string& fact) { return fact.empty() ? "none" : "'" + fact + "'"; };
    if (found != expected)
      throw Error(fmt::format("{}: found a run with {} {}, expected {} to continue", options_.db.string(),
                              what, quoted(found), quoted(expected)));
  };
  if (const auto fact = different_fact(run.info, info_)) expect(fact->name, fact->one, fact->other);
  const auto name = [](const Shard& shard) { return fmt::format("{}/{}", shard.index, shard.count); };
  expect("shard", name(run.shards.at(0)), name(shard_));
  shard_ = run.shards.at(0);
  seconds_before_ = shard_.seconds;
  statistics_ = std::move(before.statistics);
  findings_ = std::move(run.findings);
  saved_findings_ = findings_.size();
}

void Record::add(TrialResult&& result) {
  unsaved_ = true;
  statistics_.merge(result.statistics);
  for (const auto& [key, counts] : result.statistics.counts)
    if (is_set_aside(statistics_.counts[key]) && set_aside_.insert(key).second)
      fmt::print(
          stderr,
          "{}nearmiss: {} exceeded its time limit {} times in {} ({}) and is not asked there any more\n",
          isatty(STDERR_FILENO) != 0 ? "\r\033[K" : "", key.subject, most_slow, key.family,
          short_name(key.kind));
  std::move(result.findings.begin(), result.findings.end(), std::back_inserter(findings_));
  for (auto& [number, finding] : result.shrunk) findings_.at(number) = std::move(finding);
  unsaved_shrunk_ = unsaved_shrunk_ || !result.shrunk.empty();
  try {
    if (Clock::now() - last_save_ >= save_interval) save();
    if (unsaved_shrunk_ && Clock::now() - last_save_of_shrunk_ >= save_shrunk_interval) save_all();
  } catch (const StoreIsLocked&) {
    last_save_ = last_save_of_shrunk_ = Clock::now() + when_locked;
  }
}

void Record::add(const ScenePicture& picture) {
  if (store_) patiently([&] { store_->add(picture); });
}

void Record::save() {
  shard_.seconds = seconds_before_ + std::chrono::duration<double>(Clock::now() - start_).count();
  shard_.cases = statistics_.oracle_total().queries;
  if (store_) store_->save(statistics_, shard_, std::span(findings_).subspan(saved_findings_));
  saved_ = true;
  unsaved_ = false;
  saved_findings_ = findings_.size();
  last_save_ = Clock::now();
}

void Record::save_all() {
  save();
  if (store_ && unsaved_shrunk_) store_->replace(findings_);
  unsaved_shrunk_ = false;
  last_save_of_shrunk_ = Clock::now();
}

void Record::save_now() {
  patiently([&] { save_all(); });
}

void Record::add_unasked(const Subjects& subjects) {
  for (const auto& subject : subjects) {
    const auto is_own = [&](const auto& each) { return each.first.subject == subject->name(); };
    if (std::any_of(statistics_.counts.begin(), statistics_.counts.end(), is_own)) continue;
    for (const auto& [of, queries] : statistics_.oracle)
      (void)statistics_.counts[{subject->name(), of.first, of.second}];
  }
}

void Record::print_results(std::FILE* text, const Campaign& campaign, bool interrupted) const {
  const Failures failing = options_.fail_on.failures();
  const bool verbose = options_.verbose;
  const bool shows_findings = verbose || options_.fail_on.exit_code(statistics_) != exit_fine;
  if (interrupted) fmt::print(text, "INTERRUPTED; the results so far:\n");
  if (options_.summary)
    fmt::print(text, "{}",
               verbose ? summary_table(statistics_, failing)
                       : shown_lines(text, summary_lines(statistics_, failing)));
  fmt::print(text, "{}{}", sweep_tables(statistics_), ladder_table(statistics_));
  if (verbose || !options_.summary)
    fmt::print(text, "{}{}", decider_tables(statistics_), funnel_tables(statistics_));
  fmt::print(text, "{}", simulation_tables(statistics_));
  const auto findings = campaign.findings();
  print_broken(text, findings, statistics_);
  // The signatures of the findings that have been printed. Only one finding of each signature is printed.
  std::set<Signature> printed;
  for (const Finding& each : findings) {
    if (!shows_findings || printed.size() == (verbose ? printed_if_verbose : 1)) break;
    if (!verbose && is_only_shown(each.what) && failing == usual_failures()) continue;
    if (!printed.insert(signature_of(each)).second) continue;
    if (printed.size() == 1) fmt::print(text, "{}", verbose ? "\nthe first findings:\n" : "the simplest:\n");
    print(text, each, statistics_.times_seen(signature_of(each)));
  }
  if (verbose || !options_.summary) return;
  fmt::print(text, "more: {}-v shows tables\n",
             options_.db.empty()
                 ? "--db FILE keeps the results for nearmiss report; "
                 : fmt::format("nearmiss report {} -o report; ", shell_quoted(options_.db.string())));
}

int Record::finish(bool interrupted, bool complete,
                   const std::function<std::string(const Campaign&)>& describe) {
  shard_.complete = complete;
  save_now();
  store_.reset();
  end_on_signals();
  const Campaign campaign{{{info_, {shard_}, findings_, {}}}, statistics_};
  std::FILE* const text = options_.json.text();
  if (describe && !options_.verbose)
    fmt::print(text, "{}", describe(campaign));
  else
    print_results(text, campaign, interrupted);
  std::fflush(text);  // so that the user sees the text even if the file of --json cannot be written
  options_.json.write(summary_json(campaign));
  options_.ci.write(campaign, options_.fail_on.failures(), text);
  if (interrupted) return exit_interrupted;
  return options_.fail_on.exit_code(statistics_);
}

}  // namespace nearmiss::tools
