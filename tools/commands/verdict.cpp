// nearmiss verdict: prints one subject's answers to queries.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "ccd/query/error.hpp"
#include "corpus/query_text.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "fuzz/trial/judge.hpp"
#include "fuzz/trial/signatures.hpp"
#include "tools/arguments.hpp"
#include "tools/commands.hpp"

namespace nearmiss::tools {

namespace {

struct Options {
  QueryInput input;
  std::string subject = "wang", bound;
  PluginLimitOptions limits;
  bool distance_bound = false;
  bool rounded = false;
};

/// The bound B by which a false positive is judged: " B claimed" if the subject claims a bound, otherwise "
/// B wang" with wang's bound.
std::string show_distance_bound(const Subject& subject, const Judge& judge, const Query& query) {
  const BoundAnswer answer = judge.ask_unit(query);
  if (answer.fault == Fault::error)
    throw Error(fmt::format("{}: found the distance bound {}, expected 0 or more", subject.name(),
                            std::isnan(answer.bound) ? "NaN" : fmt::format("{}", answer.bound)));
  if (answer.fault != Fault::none)
    throw Error(fmt::format("{}: no distance bound: {}", subject.name(),
                            fault_signature(subject, query.kind, answer.fault, answer.fault_code)));
  return fmt::format(" {} {}", to_hex(answer.bound), subject.claims_bound() ? "claimed" : "wang");
}

void run(const Options& options) {
  const auto subject = make_any_subject(options.subject, parse_bound(options.bound), options.limits.limits());
  const Judge judge(*subject);
  options.input.read([&](const Query& query) {
    expect_kind(*subject, query.kind);
    if (query.separation > 0) expect_separation(*subject, std::array{query.kind});
    const Verdict verdict = subject->decide(query);
    if (verdict.fault != Fault::none)
      throw Error(fmt::format("{}: no answer: {}", subject->name(),
                              fault_signature(query.kind, verdict, subject->fault_text(verdict))));
    std::string line = "0";
    if (verdict.hit)
      line = fmt::format("1 {} {}", stage_names[static_cast<std::size_t>(verdict.stage)],
                         std::isfinite(verdict.time) ? to_hex(verdict.time) : "nan");
    const Query judged = subject->rounded(query);
    if (options.distance_bound) line += show_distance_bound(*subject, judge, judged);
    if (options.rounded) line += " " + to_line(judged);
    fmt::print("{}\n", line);
  });
}

}  // namespace

void add_verdict(CLI::App& app, int& /*exit_code*/) {
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand(
      "verdict",
      "Let one subject decide queries: one line each, 0, or 1 with the accepting stage and the time");
  options->input.add_to(*command);
  command
      ->add_option("--subject", options->subject, "A name (see nearmiss subjects), or the path of a plug-in")
      ->capture_default_str();
  add_bound_option(*command, options->bound);
  options->limits.add_to(*command);
  command->add_flag(
      "--distance-bound", options->distance_bound,
      "Add the distance bound of false positives, and 'claimed', or 'wang' if it is wang's bound "
      "because the subject claims none");
  command->add_flag("--rounded", options->rounded,
                    "Add the query as the subject rounds it, by which its answer is judged, with the "
                    "separation unless it is 0");
  command->footer(
      "\nExample: echo '0 0 1 0 0 0 1 0 0 0 1 0  0 0 -1 0 0 0 1 0 0 0 1 0' | "
      "nearmiss verdict --kind vt --subject wang");
  command->callback([options] { run(*options); });
}

}  // namespace nearmiss::tools
