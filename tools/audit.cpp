// nearmiss audit: compares the paper's rounding constants with what its rules give for our code, and with the
// largest errors seen.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "fuzz/studies/audit/audit.hpp"
#include "fuzz/studies/audit/tolerance_table.hpp"
#include "reports/text/text.hpp"
#include "tools/commands.hpp"
#include "tools/json_output.hpp"
#include "tools/values.hpp"

namespace nearmiss::tools {

namespace {

using nlohmann::ordered_json;

std::string number(double value, const char* format) {
  return std::isnan(value) ? "" : fmt::format(fmt::runtime(format), value);
}

ordered_json or_null(double value) { return std::isfinite(value) ? ordered_json(value) : ordered_json(); }

ordered_json json_of(const std::vector<AuditRow>& constants, const std::vector<ToleranceRow>& tolerances) {
  ordered_json json{{"constants", ordered_json::array()}, {"tolerances", ordered_json::array()}};
  for (const AuditRow& row : constants)
    json["constants"].push_back({{"name", row.name},
                                 {"section", row.section},
                                 {"unit", row.unit},
                                 {"quoted", or_null(row.quoted)},
                                 {"derived", or_null(row.derived)},
                                 {"proven", or_null(row.proven)},
                                 {"seen", or_null(row.seen)},
                                 {"slack", or_null(row.slack())},
                                 {"too_small", row.is_finding()},
                                 {"needs_proof", row.needs_proof()},
                                 {"note", row.note}});
  for (const ToleranceRow& row : tolerances)
    json["tolerances"].push_back({{"epsilon", std::exp2(row.exponent)},
                                  {"epsilon_exponent", row.exponent},
                                  {"scalars", row.scalars},
                                  {"paper_bound", row.paper_bound},
                                  {"paper_breaks", row.paper_breaks},
                                  {"tight_bound", row.tight_bound},
                                  {"tight_bound_over_B", row.relative_bound},
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

std::string table_of(const std::vector<AuditRow>& constants) {
  std::vector<std::vector<std::string>> rows{
      {"constant", "section", "unit", "quoted", "derived", "proven", "seen", "slack", ""}};
  for (const AuditRow& row : constants) {
    std::string says = row.is_finding() ? "TOO SMALL" : row.needs_proof() ? "not proven by Theorem 4.1" : "";
    if (!row.note.empty()) says += (says.empty() ? "" : ": ") + std::string(row.note);
    rows.push_back({std::string(row.name), std::string(row.section), std::string(row.unit),
                    number(row.quoted, "{:.5g}"), number(row.derived, "{:.5g}"), number(row.proven, "{:.5g}"),
                    number(row.seen, "{:.3g}"), number(row.slack(), "{:.3g}"), says});
  }
  return columns(rows, 3);
}

std::string table_of(const std::vector<ToleranceRow>& tolerances) {
  std::vector<std::vector<std::string>> rows{{"scalar", "epsilon", "paper, B e", "closed forms",
                                              "smallest, B e", "in B", "mu/eps", "tau", "eta", "R",
                                              "lambda^2", "D^2", "psi"}};
  for (const ToleranceRow& row : tolerances)
    rows.push_back({std::string(row.scalars), fmt::format("2^{}", row.exponent),
                    fmt::format("{:.2f}", row.paper_bound),
                    row.paper_breaks.empty() ? "hold" : fmt::format("break {}", row.paper_breaks),
                    fmt::format("{:.2f}", row.tight_bound), fmt::format("{:.3g}", row.relative_bound),
                    fmt::format("{:.0f}", row.tight.mu), fmt::format("{:.2f}", row.tight.tau),
                    fmt::format("{:.3f}", row.tight.eta), fmt::format("{:.3f}", row.tight.R),
                    fmt::format("{:.3g}", row.tight.lambda2), fmt::format("{:.1f}", row.tight.D2),
                    fmt::format("{:.2g}", row.tight.psi)});
  return columns(rows, 1);
}

}  // namespace

void add_audit(CLI::App& app, int& exit_code) {
  struct Options {
    AuditPlan plan;
    JsonOutput json;
  };
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand(
      "audit", "Derive the paper's rounding constants from our code, and search for the largest errors");
  add_count_option(*command, "--queries", options->plan.queries, 1, 1'000'000,
                   "Number of queries of each family");
  add_count_option(*command, "--steps", options->plan.steps, 0, 100'000'000,
                   "Steps of the hill climb for each constant");
  command->add_option("--seed", options->plan.seed, "Seed of all queries and steps")
      ->capture_default_str()
      ->type_name("S");
  options->json.add_to(*command, "Write the tables as JSON, for nearmiss report --audit");
  command->footer("\nExit code 1: an error exceeded what the rules allow. That would be a bug in nearmiss.");
  command->callback([options, &exit_code] {
    const std::vector<AuditRow> constants = audit(options->plan);
    const std::vector<ToleranceRow> tolerances = tolerance_table();
    options->json.write(json_of(constants, tolerances), 1);
    fmt::print(options->json.text(), "{}\n{}", table_of(constants), table_of(tolerances));
    for (const AuditRow& row : constants)
      if (row.violations != 0) exit_code = exit_found;
  });
}

}  // namespace nearmiss::tools
