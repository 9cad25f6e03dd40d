// nearmiss audit: compares the paper's rounding constants with the constants that the paper's rules give for
// our code, and with proven constants.
#include "fuzz/studies/audit.hpp"

#include <fmt/format.h>

#include <cmath>

#include "reports/text/json.hpp"
#include "reports/text/text.hpp"
#include "tools/commands.hpp"
#include "tools/json_output.hpp"

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

/// The distance bound that the smallest possible tolerances give, in units of B.
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

}  // namespace nearmiss::tools
