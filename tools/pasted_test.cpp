#include "tools/pasted_test.hpp"

#include <fmt/format.h>

#include <sstream>

#include "ccd/error.hpp"
#include "ccd/printable.hpp"
#include "corpus/query_text.hpp"
#include "oracle/explanation.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss::tools {

namespace {

/// A floating-point literal of exactly this value.
std::string literal(double value, Form language) {
  std::string text = to_exact(value);
  if (text.find("0x") != std::string::npos)
    return language == Form::python ? fmt::format("float.fromhex('{}')", text) : text;
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

/// The four vertices at a time (0 or 1): a line for each.
std::string vertices(const Query& query, std::size_t time, Form language) {
  const bool python = language == Form::python;
  std::string text;
  for (std::size_t vertex = 0; vertex < 4; ++vertex) {
    const double* const x = query.x.data() + 12 * time + 3 * vertex;
    text += fmt::format(fmt::runtime(python ? "        [{}, {}, {}],\n" : "      {{{}, {}, {}}},\n"),
                        literal(x[0], language), literal(x[1], language), literal(x[2], language));
  }
  return text;
}

std::string what_is_true(const Query& query) {
  auto contact = earliest_time(query);
  if (!contact) return "The primitives do not touch at any t in [0, 1].";
  const auto [lo, hi] = contact->enclosure();
  if (lo == hi) return fmt::format("The primitives touch, first at t = {}.", to_exact(lo));
  return fmt::format("The primitives touch, first between t = {} and t = {}.", to_hex(lo), to_hex(hi));
}

std::string what_was_answered(const Finding& finding) {
  switch (finding.what) {
    case Finding::What::false_negative:
      return "reported no collision";
    case Finding::What::refuted_bound:
      return "reported a collision, although the primitives are farther apart than the bound that it claims";
    case Finding::What::fault:
      return fmt::format("gave no answer ({})", printable(finding.signature));
    default:
      throw Error(fmt::format("--as: found a finding of the kind {}, expected a failure of a subject",
                              name(finding.what)));
  }
}

/// The lines of the comment on top of the test.
std::string comment(const Finding& finding, std::string_view mark) {
  const bool is_vt = finding.shrunk.kind == Kind::vertex_triangle;
  std::istringstream lines(
      fmt::format("{} (found by nearmiss).\nVertices move linearly from `start` (t = 0) to `end` (t = "
                  "1).\n{}\n{}\n{} {}.\n",
                  is_vt ? "A vertex (the first point) and a triangle (the other three)"
                        : "Two edges (the first two points, and the last two)",
                  what_is_true(finding.shrunk), fmt::format("Also: {}.", to_text(explain(finding.shrunk))),
                  printable(finding.subject), what_was_answered(finding)));
  std::string text;
  for (std::string line; std::getline(lines, line);) text += fmt::format("{} {}\n", mark, line);
  return text;
}

}  // namespace

Form parse_form(std::string_view text, std::string_view option) {
  if (text == "case") return Form::case_file;
  if (text == "c++") return Form::cpp;
  if (text == "python") return Form::python;
  throw Error(fmt::format("{}: found '{}', expected case, c++ or python", option, printable(text)));
}

std::string pasted_test(const Finding& finding, Form language) {
  const Query& query = finding.shrunk;
  const bool collision = collides(query);
  const std::string name = query.kind == Kind::vertex_triangle ? "test_vertex_triangle" : "test_edge_edge";
  const std::string start = vertices(query, 0, language);
  const std::string end = vertices(query, 1, language);
  if (language == Form::python)
    return fmt::format(
        "{}# Write a function detects(start, end) that returns whether your detector reports a collision.\n"
        "def {}():\n    start = [\n{}    ]\n    end = [\n{}    ]\n    assert {}detects(start, end)\n",
        comment(finding, "#"), name, start, end, collision ? "" : "not ");
  return fmt::format(
      "{}// Write a function `detects` that returns whether your detector reports a collision.\n"
      "bool detects(const double (&start)[4][3], const double (&end)[4][3]);\n\n"
      "bool {}() {{\n  const double start[4][3] = {{\n{}  }};\n  const double end[4][3] = {{\n{}  }};\n"
      "  return detects(start, end) == {};\n}}\n",
      comment(finding, "//"), name, start, end, collision);
}

}  // namespace nearmiss::tools
