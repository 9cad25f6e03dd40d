// nearmiss verdict: one subject's answers.
#include <fmt/format.h>

#include "corpus/query_text.hpp"
#include "oracle/subjects.hpp"
#include "tools/arguments.hpp"
#include "tools/commands.hpp"

namespace nearmiss::tools {

namespace {

struct Options {
  std::string kind, subject = "wang", bound, file = "-";
};

void run(const Options& options) {
  const Kind kind = parse_kind(options.kind, "--kind");
  const auto given = options.bound.empty() ? std::nullopt : std::optional(parse_bound(options.bound));
  const auto subject = make_any_subject(options.subject, given);
  read_queries(options.file, kind, [&](const Query& query) {
    const Verdict verdict = subject->decide(query);
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
  add_kind_option(*command, options->kind);
  command->add_option("--subject", options->subject, "A built-in name, or the path of a plug-in")
      ->capture_default_str();
  command->add_option("--bound", options->bound, "Use this B for every pair, in place of each pair's own")
      ->type_name("B");
  command
      ->add_option("FILE", options->file, "One query a line: 24 numbers, x0 x1 x2 x3 at t = 0, then at t = 1")
      ->capture_default_str();
  command->footer(
      "\nExample: echo '0 0 1 0 0 0 1 0 0 0 1 0  0 0 -1 0 0 0 1 0 0 0 1 0' | "
      "nearmiss verdict --kind vt --subject wang");
  command->callback([options] { run(*options); });
}

}  // namespace nearmiss::tools
