// nearmiss verdict: one subject's answers.
#include <fmt/format.h>

#include <cmath>

#include "ccd/error.hpp"
#include "corpus/query_text.hpp"
#include "fuzz/failures/failure.hpp"
#include "fuzz/subjects.hpp"
#include "tools/arguments.hpp"
#include "tools/commands.hpp"

namespace nearmiss::tools {

namespace {

struct Options {
  QueryInput input;
  std::string subject = "wang", bound;
};

void run(const Options& options) {
  const auto subject = make_any_subject(options.subject, parse_bound(options.bound));
  options.input.read([&](const Query& query) {
    const Verdict verdict = subject->decide(query);
    if (verdict.fault != Fault::none)
      throw Error(fmt::format("{}: no answer: {}", subject->name(), fault_signature(query.kind, verdict)));
    if (verdict.hit)
      fmt::print("1 {} {}\n", stage_names[static_cast<std::size_t>(verdict.stage)],
                 std::isfinite(verdict.time) ? to_hex(verdict.time) : "nan");
    else
      fmt::print("0\n");
  });
}

}  // namespace

void add_verdict(CLI::App& app, int& /*exit_code*/) {
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand(
      "verdict", "Decide queries by one subject: a line each, 0, or 1 with the accepting stage and the time");
  options->input.add_to(*command);
  command->add_option("--subject", options->subject, "A built-in name, or the path of a plug-in")
      ->capture_default_str();
  add_bound_option(*command, options->bound);
  command->footer(
      "\nExample: echo '0 0 1 0 0 0 1 0 0 0 1 0  0 0 -1 0 0 0 1 0 0 0 1 0' | "
      "nearmiss verdict --kind vt --subject wang");
  command->callback([options] { run(*options); });
}

}  // namespace nearmiss::tools
