#include "fuzz/interface/trial_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "ccd/query/printable.hpp"
#include "corpus/query_text.hpp"
#include "fuzz/trial/truth.hpp"
#include "oracle/explanation.hpp"
#include "oracle/oracle.hpp"
#include "reports/sections/headline.hpp"
#include "reports/sections/verdicts.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

constexpr std::size_t most_lines = 15;

std::size_t lines_in(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

std::string_view macro_of(Kind kind) {
  constexpr std::array<std::string_view, kinds.size()> macros{
      "NEARMISS_VERTEX_TRIANGLE", "NEARMISS_EDGE_EDGE", "NEARMISS_VERTEX_VERTEX", "NEARMISS_VERTEX_EDGE"};
  return macros[static_cast<std::size_t>(kind)];
}

/// The query's positions at a time (0 or 1), separated by commas.
std::string positions(const Query& query, std::size_t time) {
  std::string text;
  for (int vertex = 0; vertex < vertices(query.kind); ++vertex) {
    const double* const x = query.x.data() + 12 * time + 3 * static_cast<std::size_t>(vertex);
    text +=
        fmt::format("{}{}, {}, {}", vertex == 0 ? "" : ",  ", to_exact(x[0]), to_exact(x[1]), to_exact(x[2]));
  }
  return text;
}

bool is_identifier(std::string_view text) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return !text.empty() && is_letter(text.front()) &&
         std::ranges::all_of(text, [&](char c) { return is_letter(c) || (c >= '0' && c <= '9'); });
}

/// A C++ condition that holds if the answer to the finding's query is right. `arguments` are the arguments
/// for nearmiss::ask.
std::string expectation(const Finding& finding, const std::string& arguments) {
  const std::string answer = "nearmiss::ask" + arguments;
  auto earliest = earliest_time(finding.shrunk);
  switch (finding.what) {
    case Finding::What::fault:
      return "nearmiss::answers" + arguments;
    case Finding::What::late:
      return fmt::format("{}.time <= {}", answer, to_exact(earliest ? earliest->enclosure().lo : 1));
    case Finding::What::unsafe_step:
      return fmt::format("{}.time < {}", answer, to_exact(finding.time));
    default:
      return earliest ? answer : "!" + answer;
  }
}

/// The finding as C++ code that a user can paste into a test.
std::string example(const TrialSetting& setting, const Finding& finding) {
  const Query& query = finding.shrunk;
  constexpr std::string_view indent = "      ";
  const std::string arguments =
      fmt::format("({}, {{{}, x, {}}})", is_identifier(setting.subject) ? setting.subject : "ccd",
                  macro_of(query.kind), to_exact(query.separation));
  const std::string start = fmt::format("  const double x[] = {{{},", positions(query, 0));
  return wrapped(start, indent, most_lines) +
         wrapped(fmt::format("{}{}}};", indent, positions(query, 1)), indent, most_lines) +
         wrapped(fmt::format("  {}({});", setting.check, expectation(finding, arguments)), indent,
                 most_lines);
}

std::string what_happens(const Finding& finding) {
  auto earliest = earliest_time(finding.shrunk);
  const std::string when = earliest ? fmt::format("t = {:.6g}: ", earliest->enclosure().lo) : "";
  return when + to_text(explain(finding.shrunk));
}

std::string_view words_for(Finding::What what) {
  if (what == Finding::What::false_negative) return "misses";
  if (what == Finding::What::late) return "gives a late time for";
  if (what == Finding::What::unsafe_step) return "gives an unsafe step for";
  return what == Finding::What::refuted_bound ? "reports beyond its bound" : "does not answer";
}

}  // namespace

std::string trial_text(const TrialSetting& setting, const Statistics& statistics,
                       const std::vector<Finding>& findings) {
  std::string shown;
  if (has_failed(statistics) && !findings.empty()) {
    const Finding& first = findings.front();
    shown = wrapped(fmt::format("A simple {} {} query that it {} ({}, found in {}):", name(first.query_class),
                                short_name(first.query.kind), words_for(first.what),
                                printable(first.signature), first.family),
                    "  ", 2) +
            example(setting, first) + wrapped("  // " + what_happens(first), "", 1);
  }
  const std::size_t left = most_lines - std::min(lines_in(shown), most_lines - 1);
  std::string text =
      wrapped(fmt::format("{} Seed {}.", headline(statistics, std::nullopt).text, setting.seed), "  ",
              std::min(left, std::size_t{3}));
  for (const SubjectVerdict& each : subject_verdicts(statistics))
    if (const std::size_t used = lines_in(text); used < left)
      text += wrapped("  " + each.text, "    ", std::min(left - used, std::size_t{3}));
  return text + shown;
}

}  // namespace nearmiss
