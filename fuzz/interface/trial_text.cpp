#include "fuzz/interface/trial_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "corpus/query_text.hpp"
#include "fuzz/trial/truth.hpp"
#include "oracle/explanation.hpp"
#include "oracle/oracle.hpp"
#include "reports/sections/headline.hpp"
#include "reports/sections/verdicts.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

constexpr std::size_t widest = 100;

/// The text in lines of at most `widest` columns, as far as blanks allow it; lines after the first are indented.
std::string wrapped(std::string_view text, std::string_view indent) {
  std::string lines;
  while (text.size() > widest) {
    const std::size_t end = text.rfind(' ', widest);
    if (end == std::string_view::npos || end <= indent.size()) break;
    lines.append(text.substr(0, end)).append("\n").append(indent);
    text.remove_prefix(end + 1);
  }
  return lines.append(text).append("\n");
}

std::string_view macro_of(Kind kind) {
  switch (kind) {
    case Kind::vertex_triangle:
      return "NEARMISS_VERTEX_TRIANGLE";
    case Kind::edge_edge:
      return "NEARMISS_EDGE_EDGE";
    case Kind::vertex_vertex:
      return "NEARMISS_VERTEX_VERTEX";
    case Kind::vertex_edge:
      return "NEARMISS_VERTEX_EDGE";
  }
  return "";
}

/// The positions at a time (0 or 1), which start after `indent`.
std::string positions(const Query& query, std::size_t time, std::string_view indent) {
  std::string text;
  for (int vertex = 0; vertex < vertices(query.kind); ++vertex) {
    const double* const x = query.x.data() + 12 * time + 3 * static_cast<std::size_t>(vertex);
    const std::string point = fmt::format("{}, {}, {}", to_exact(x[0]), to_exact(x[1]), to_exact(x[2]));
    const bool fits = text.size() - (text.rfind('\n') + 1) + point.size() + indent.size() < widest;
    if (vertex > 0) text += fits ? ",  " : fmt::format(",\n{}", indent);
    text += point;
  }
  return text;
}

/// What a right answer to the finding's query is, as a condition on `answer`.
std::string expectation(const Finding& finding, const std::string& answer) {
  auto earliest = earliest_time(finding.shrunk);
  if (finding.what == Finding::What::late && earliest)
    return fmt::format("{}.time <= {}", answer, to_exact(earliest->enclosure().lo));
  return earliest ? answer : "!" + answer;
}

/// The finding as code that can be pasted into a test.
std::string example(const TrialSetting& setting, const Finding& finding) {
  const Query& query = finding.shrunk;
  constexpr std::string_view indent = "                      ";
  const std::string answer = fmt::format("nearmiss::ask({}, {{{}, x, {}}})", setting.subject,
                                         macro_of(query.kind), to_exact(query.separation));
  return fmt::format("  const double x[] = {{{},\n{}{}}};\n  {}({});\n", positions(query, 0, indent), indent,
                     positions(query, 1, indent), setting.check, expectation(finding, answer));
}

/// What happens in the finding's query, in words.
std::string what_happens(const Finding& finding) {
  auto earliest = earliest_time(finding.shrunk);
  const std::string when = earliest ? fmt::format("t = {:.6g}: ", earliest->enclosure().lo) : "";
  return when + to_text(explain(finding.shrunk));
}

std::string_view words_for(Finding::What what) {
  switch (what) {
    case Finding::What::false_negative:
      return "misses";
    case Finding::What::late:
      return "gives a late time for";
    case Finding::What::unsafe_step:
      return "gives an unsafe step for";
    case Finding::What::refuted_bound:
      return "reports beyond its bound";
    default:
      return "does not answer";
  }
}

}  // namespace

std::string trial_text(const TrialSetting& setting, const Statistics& statistics,
                       const std::vector<Finding>& findings) {
  const std::vector<SubjectVerdict> verdicts = subject_verdicts(statistics);
  const bool is_clean = !has_failed(statistics);
  std::string text =
      wrapped(fmt::format("{} Seed {}.", headline(statistics, std::nullopt).text, setting.seed), "  ");
  for (const SubjectVerdict& each : verdicts) text += wrapped(fmt::format("  {}", each.text), "    ");
  if (is_clean || findings.empty()) return text;
  const Finding& first = findings.front();
  text +=
      wrapped(fmt::format("The simplest {} {} query that it {} ({}, found in {}):", name(first.query_class),
                          short_name(first.query.kind), words_for(first.what), first.signature, first.family),
              "  ");
  text += example(setting, first);
  text += wrapped("  // " + what_happens(first), "  // ");
  return text;
}

}  // namespace nearmiss
