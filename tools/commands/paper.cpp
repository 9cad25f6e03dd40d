// nearmiss audit shows three values of each rounding constant side by side: the one in the paper, the one
// that the paper's rules give for our code, and the proven one. nearmiss paper shows the paper's quantitative
// claims beside our measurements.
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "fuzz/studies/audit.hpp"
#include "reports/text/json.hpp"
#include "reports/text/text.hpp"
#include "tools/commands.hpp"
#include "tools/outputs.hpp"
#include "tools/paper/claims.hpp"
#include "tools/record.hpp"
#include "tools/terminal.hpp"

namespace nearmiss::tools {

namespace {

using nlohmann::ordered_json;

std::vector<RoundingConstant> all_constants() {
  auto all = rounding_bounds();
  const auto more = rounding_consequences();
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::string number(double value, const char* format) {
  return std::isnan(value) ? "" : fmt::format(fmt::runtime(format), value);
}

ordered_json or_null(double value) { return std::isfinite(value) ? ordered_json(value) : ordered_json(); }

/// The bound on the distance of false positives that follows from the smallest possible tolerances. The unit
/// of this bound is B, the size of the pair.
double bound_over_B(const ToleranceRow& row) { return row.tight_bound * std::exp2(row.exponent / 4.0); }

ordered_json json_of(const std::vector<RoundingConstant>& constants,
                     const std::vector<ToleranceRow>& tolerances) {
  ordered_json json{{"constants", ordered_json::array()}, {"tolerances", ordered_json::array()}};
  for (const RoundingConstant& row : constants)
    json["constants"].push_back({{"name", row.name},
                                 {"section", row.section},
                                 {"unit", row.unit},
                                 {"quoted", or_null(row.quoted)},
                                 {"derived", or_null(row.derived)},
                                 {"proven", or_null(row.proven)},
                                 {"slack", or_null(row.slack())},
                                 {"too_small", row.is_too_small()},
                                 {"needs_proof", row.needs_proof()},
                                 {"note", row.note}});
  for (const ToleranceRow& row : tolerances)
    json["tolerances"].push_back({{"epsilon", std::exp2(row.exponent)},
                                  {"epsilon_exponent", row.exponent},
                                  {"scalars", row.scalar},
                                  {"paper_bound", row.paper_bound},
                                  {"paper_breaks", row.paper_breaks},
                                  {"paper_breaks_as_printed", row.printed_breaks},
                                  {"tight_bound", row.tight_bound},
                                  {"tight_bound_over_B", bound_over_B(row)},
                                  {"mu", row.tight.mu},
                                  {"tau", row.tight.tau},
                                  {"eta", row.tight.eta},
                                  {"R", row.tight.R},
                                  {"lambda2", row.tight.lambda2},
                                  {"D2", row.tight.D2},
                                  {"psi", row.tight.psi},
                                  {"rho", row.tight.rho}});
  return json;
}

std::string table_of(const std::vector<RoundingConstant>& constants) {
  std::vector<std::vector<std::string>> rows{
      {"constant", "section", "unit", "quoted", "derived", "proven", "slack", ""}};
  for (const RoundingConstant& row : constants) {
    std::string says = row.is_too_small()  ? "TOO SMALL"
                       : row.needs_proof() ? "not proven by Theorem 4.1"
                                           : "";
    if (!row.note.empty()) says += (says.empty() ? "" : ": ") + std::string(row.note);
    rows.push_back({std::string(row.name), std::string(row.section), std::string(row.unit),
                    number(row.quoted, "{:.5g}"), number(row.derived, "{:.5g}"), number(row.proven, "{:.5g}"),
                    number(row.slack(), "{:.3g}"), says});
  }
  return columns(rows, 3);
}

std::string table_of(const std::vector<ToleranceRow>& tolerances) {
  std::vector<std::vector<std::string>> rows{{"scalar", "epsilon", "paper, B e", "closed forms",
                                              "smallest, B e", "in B", "mu/eps", "tau", "eta", "R",
                                              "lambda^2", "D^2", "psi"}};
  for (const ToleranceRow& row : tolerances)
    rows.push_back({std::string(row.scalar), fmt::format("2^{}", row.exponent),
                    fmt::format("{:.2f}", row.paper_bound),
                    row.paper_breaks.empty() ? "hold" : fmt::format("break {}", row.paper_breaks),
                    fmt::format("{:.2f}", row.tight_bound), fmt::format("{:.3g}", bound_over_B(row)),
                    fmt::format("{:.0f}", row.tight.mu), fmt::format("{:.2f}", row.tight.tau),
                    fmt::format("{:.3f}", row.tight.eta), fmt::format("{:.3f}", row.tight.R),
                    fmt::format("{:.3g}", row.tight.lambda2), fmt::format("{:.1f}", row.tight.D2),
                    fmt::format("{:.2g}", row.tight.psi)});
  return columns(rows, 1);
}

}  // namespace

void add_audit(CLI::App& app, int& /*exit_code*/) {
  auto json = std::make_shared<JsonOutput>();
  auto* command = app.add_subcommand("audit",
                                     "Compare the paper's rounding constants with what its rules give for "
                                     "our code, and with what is proven");
  json->add_to(*command, "Write the tables as JSON, for nearmiss report --audit");
  command->callback([json] {
    const auto constants = all_constants();
    const auto tolerances = tolerance_table();
    json->write(json_of(constants, tolerances), 1);
    fmt::print(json->text(), "{}\n{}", table_of(constants), table_of(tolerances));
  });
}

namespace {

using paper::Claim;
using paper::Measured;
using paper::Results;

struct PaperOptions {
  std::vector<std::string> names;
  bool list = false, quiet = false;
  JsonOutput json;
};

/// Redirects a standard stream to another file until the object is destroyed.
class Redirection {
 public:
  Redirection(std::FILE* stream, int to) : stream_(stream) {
    std::fflush(stream_);
    kept_ = fcntl(fileno(stream_), F_DUPFD_CLOEXEC, 3);
    if (kept_ < 0 || dup2(to, fileno(stream_)) < 0)
      throw Error("found no free file descriptor, expected one");
  }
  Redirection(const Redirection&) = delete;
  Redirection& operator=(const Redirection&) = delete;
  ~Redirection() {
    std::fflush(stream_);
    dup2(kept_, fileno(stream_));
    close(kept_);
  }

 private:
  std::FILE* stream_;
  int kept_;
};

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

std::string contents(std::FILE* file) {
  std::string text;
  std::rewind(file);
  for (char buffer[1 << 16]; const std::size_t size = std::fread(buffer, 1, sizeof buffer, file);)
    text.append(buffer, size);
  return text;
}

/// Runs a subcommand in this process with --json -, and returns its JSON. Throws Error if the subcommand
/// fails, and Stopped if it is interrupted.
ordered_json results_of(std::string_view command) {
  int exit_code = exit_fine;
  CLI::App app;
  for (const auto add : {add_audit, add_bench, add_fuzz, add_simulate, add_tightness}) add(app, exit_code);
  const File output(std::tmpfile(), std::fclose);
  const File nothing(std::fopen("/dev/null", "w"), std::fclose);
  if (!output || !nothing) throw Error("found no temporary file, expected one");
  {
    const Redirection results(stdout, fileno(output.get()));
    const Redirection text(stderr, fileno(nothing.get()));
    app.parse(fmt::format("{} --json -", command));
  }
  if (exit_code == exit_interrupted) throw Stopped();
  return ordered_json::parse(contents(output.get()));
}

std::vector<std::string> commands_of(const Claim& claim) {
  std::vector<std::string> commands;
  for (const std::string_view command : claim.commands)
    commands.push_back(fmt::format("nearmiss {}", command));
  if (commands.empty()) commands.push_back(fmt::format("nearmiss paper {}", claim.name));
  return commands;
}

std::vector<const Claim*> chosen(const std::vector<std::string>& names) {
  std::vector<const Claim*> all;
  std::vector<std::string_view> known;
  for (const Claim& claim : paper::claims()) {
    known.push_back(claim.name);
    if (names.empty() || std::ranges::count(names, claim.name) > 0) all.push_back(&claim);
  }
  for (const std::string& name : names)
    if (std::ranges::count(known, name) == 0)
      throw Error(
          fmt::format("found the claim '{}', expected some of {}", excerpt(name), fmt::join(known, ", ")));
  return all;
}

void list(const std::vector<std::string>& names) {
  for (const Claim* claim : chosen(names))
    fmt::print("{} ({}): {}\n    {}\n", claim->name, claim->section, claim->says,
               fmt::join(commands_of(*claim), "\n    "));
}

void print(std::FILE* out, const Claim& claim, const Measured& measured) {
  fmt::print(out, "{}: {}\n  {} says: {}\n  measured: {}\n", claim.name, name(measured.judgement),
             claim.section, claim.says, measured.text);
  std::fflush(out);
}

ordered_json json_of(const Claim& claim, const Measured& measured) {
  return {{"name", claim.name},
          {"section", claim.section},
          {"says", claim.says},
          {"measured", measured.text},
          {"verdict", name(measured.judgement)},
          {"commands", commands_of(claim)}};
}

int run(const PaperOptions& options) {
  const auto which = chosen(options.names);
  options.json.expect_writable();
  const Stop stop(interrupted());
  Progress progress(options.quiet);
  // The results of each command that has run; several claims may need the results of the same command.
  std::map<std::string_view, ordered_json> known;
  ordered_json json{{"run", run_info("paper")}, {"claims", ordered_json::array()}};
  json["run"].update(ordered_json(environment()));
  double done = 0;
  try {
    for (const Claim* claim : which) {
      // Calls stop_on_signals() again for each claim, because each command of a claim ends with
      // end_on_signals().
      stop_on_signals();
      progress.show(std::string(claim->name), done++ / static_cast<double>(which.size()));
      Results results;
      for (const std::string_view command : claim->commands) {
        if (!known.contains(command)) known.emplace(command, results_of(command));
        results.push_back(known.at(command));
      }
      const Measured measured = claim->measured(results, stop);
      print(options.json.text(), *claim, measured);
      json["claims"].push_back(json_of(*claim, measured));
    }
  } catch (const Stopped&) {  // the code below still writes the claims that were measured before the stop
  }
  end_on_signals();
  options.json.write(json);
  return stop.is_requested() ? exit_interrupted : exit_fine;
}

}  // namespace

void add_paper(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<PaperOptions>();
  auto* command = app.add_subcommand(
      "paper", "Measure each quantitative claim of the paper: what it says, what we find, does it hold");
  command->add_option("CLAIM", options->names, "Names of claims; all of them if there is none");
  auto* list_only =
      command->add_flag("--list", options->list, "List the claims, and the commands that measure them");
  options->json.add_to(*command, "Write the table as JSON, for nearmiss report --paper");
  list_only->excludes("--json");
  command->add_flag("-q,--quiet", options->quiet, "Show no progress");
  command->footer("\nThe exit code is 0 whether claims hold or not.");
  command->callback([options, &exit_code] {
    if (options->list) return list(options->names);
    exit_code = run(*options);
  });
}

}  // namespace nearmiss::tools
