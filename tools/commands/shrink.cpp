// nearmiss shrink: finds the simplest query, of the class of a given query, on which a subject fails in the same way.
#include <fmt/format.h>

#include <array>
#include <filesystem>

#include "ccd/query/error.hpp"
#include "corpus/file.hpp"
#include "corpus/readers.hpp"
#include "fuzz/families/classify.hpp"
#include "fuzz/subjects/contracted.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "fuzz/trial/judge.hpp"
#include "fuzz/trial/shrunk_finding.hpp"
#include "oracle/explanation.hpp"
#include "oracle/oracle.hpp"
#include "reports/campaign/complexity.hpp"
#include "tools/arguments.hpp"
#include "tools/commands.hpp"
#include "tools/pasted_test.hpp"

namespace nearmiss::tools {

namespace {

struct ShrinkOptions {
  std::filesystem::path in, out;
  std::string subject = "wang", form = "case";
  PluginLimitOptions limits;
  SeparationOption separation;
};

/// The only case in the file. If the option --separation is given, its value replaces the separation of the
/// case.
Case read_one(const ShrinkOptions& options) {
  std::vector<Case> cases;
  read_cases(options.in, [&](Case&& each) { cases.push_back(std::move(each)); });
  if (cases.size() != 1)
    throw Error(fmt::format("{}: found {} queries, expected one", options.in.string(), cases.size()));
  cases.front().query = options.separation.apply(cases.front().query);
  return cases.front();
}

/// The failure of the oracle or of the subject on a query. Checks the oracle first, because the oracle judges
/// the subject.
Finding find_failure(const Case& each, const Subject& subject) {
  std::optional<Failure> failure = oracle_failure(each.query);
  if (!failure) failure = Judge(subject).failure(each.query);
  if (failure)
    return {.what = failure->what,
            .subject = subject.name(),
            .family = {},
            .query = each.query,
            .provenance = each.name,
            .signature = failure->signature,
            .query_class = classify(each.query)};
  throw Error(
      fmt::format("{}: {} does not fail, expected a missed collision, a late time, a report beyond its "
                  "bound, no answer or an "
                  "oracle disagreement",
                  each.name, subject.name()));
}

/// Makes the subject, in a wrapper that restricts which queries the subject is asked. If `query` keeps the
/// subject's contract, the wrapper asks only queries that keep the contract. Otherwise, it asks only queries
/// that break the contract.
std::unique_ptr<Subject> made_for(const Query& query, const ShrinkOptions& options) {
  auto sides = keep_contract(make_any_subject(options.subject, std::nullopt, options.limits.limits()), true);
  const Subject& subject = *sides.front();
  expect_kind(subject, query.kind);
  if (query.separation > 0) expect_separation(subject, std::array{query.kind});
  const bool keeps = keeps_contract(subject.rounded(query), subject.contract());
  return std::move(keeps ? sides.front() : sides.back());
}

Case shrunk_case(const Finding& finding, const std::string& became) {
  return {.name = {},
          .query = finding.shrunk,
          .truth = collides(finding.shrunk),
          .why = fmt::format("{} of {}: {}\n{}\n{}", name(finding.what), finding.subject, finding.signature,
                             became, to_text(explain(finding.shrunk))),
          .provenance = "shrunk from " + finding.provenance};
}

/// Writes a text to the file of --out or, without --out, to stdout. The file gets the whole text, or stays as
/// it was.
void write(const std::string& text, const ShrinkOptions& options, const std::string& became) {
  if (options.out.empty()) {
    fmt::print("{}", text);
  } else {
    replace_file(options.out, text);
    fmt::print("{}\n", became);
  }
}

void run(const ShrinkOptions& options) {
  const Form form = parse_form(options.form, "--as");
  const Case each = read_one(options);
  const auto subject = made_for(each.query, options);
  Finding finding = find_failure(each, *subject);
  finding.shrunk = shrunk_query(finding, subject.get());
  if (finding.what == Finding::What::refuted_bound) finding.bound = subject->ask_bound(finding.shrunk).bound;
  const Complexity before = complexity(finding.query);
  const Complexity after = complexity(finding.shrunk);
  const std::string became = fmt::format("distinct numbers: {} -> {}; their significant bits: {} -> {}",
                                         before.distinct, after.distinct, before.bits, after.bits);
  const bool is_case = form == Form::case_file;
  write(is_case ? to_text(shrunk_case(finding, became)) : pasted_test(finding, form), options, became);
}

}  // namespace

void add_shrink(CLI::App& app, int& /*exit_code*/) {
  auto options = std::make_shared<ShrinkOptions>();
  auto* command = app.add_subcommand(
      "shrink", "Turn a failing query into the simplest one of its class that fails in the same way");
  command->add_option("CASE", options->in, "A *.case file, or a *.vt, *.ee, *.vv or *.ve file of one query")
      ->required();
  command
      ->add_option("--subject", options->subject, "A name (see nearmiss subjects), or the path of a plug-in")
      ->capture_default_str();
  options->limits.add_to(*command);
  options->separation.add_to(*command);
  command->add_option("-o,--output", options->out, "Write to this file instead of stdout")->type_name("FILE");
  command
      ->add_option(
          "--as", options->form,
          "What to print: a case, or a test in c++, for gtest or in python to paste into the subject's own "
          "project; the tests "
          "contain a certificate of the right answer, and that in python checks it")
      ->type_name("case|c++|gtest|python")
      ->capture_default_str();
  command->footer(
      "\nTwo failures are the same if their kind is, and the features of the first contact (of a missed "
      "collision or of a\nlate time), "
      "the stage that accepted (of a report beyond the bound), or the fault (of no answer).\n"
      "Example: nearmiss shrink corpus/cases/rounding/vt-planted.case --subject basic");
  command->callback([options] { run(*options); });
}

}  // namespace nearmiss::tools
