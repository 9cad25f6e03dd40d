#include "tools/pasted_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "ccd/query/error.hpp"
#include "ccd/query/printable.hpp"
#include "corpus/query_text.hpp"
#include "fuzz/trial/certified.hpp"
#include "fuzz/trial/signatures.hpp"
#include "oracle/explanation.hpp"
#include "oracle/oracle.hpp"
#include "tools/certificates/check.hpp"

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

/// The vertices of a query at t = `time`, which is 0 or 1: a line of source code for each vertex.
std::string points(const Query& query, std::size_t time, Form language) {
  const bool python = language == Form::python;
  std::string text;
  for (int vertex = 0; vertex < vertices(query.kind); ++vertex) {
    const double* const x = query.x.data() + 12 * time + 3 * static_cast<std::size_t>(vertex);
    text += fmt::format(fmt::runtime(python ? "        [{}, {}, {}],\n" : "      {{{}, {}, {}}},\n"),
                        literal(x[0], language), literal(x[1], language), literal(x[2], language));
  }
  return text;
}

/// What happens at the earliest time of the collision, in words: "The primitives touch".
std::string what_happens(const Query& query) {
  return query.separation == 0
             ? "The primitives touch"
             : fmt::format("The primitives come within {} of each other", to_exact(query.separation));
}

std::string what_is_true(const Query& query) {
  auto earliest = earliest_time(query);
  if (!earliest && query.separation == 0) return "The primitives do not touch at any t in [0, 1].";
  if (!earliest)
    return fmt::format("The distance of the primitives is more than {} at all t in [0, 1].",
                       to_exact(query.separation));
  const auto [lo, hi] = earliest->enclosure();
  if (lo == hi) return fmt::format("{}, first at t = {}.", what_happens(query), to_exact(lo));
  return fmt::format("{}, first at about t = {:.6g}, between {} and {}.", what_happens(query), lo, to_hex(lo),
                     to_hex(hi));
}

/// The largest double that is not a late time. For a separation h > 0, a time is late if the distance is
/// already below h at an earlier time. For contact, a time is late if it is after t*, the exact earliest
/// time. Throws Error if the distance does not fall below h > 0 right after t*, because then times just after
/// t* are not late.
double largest_time(const Query& query) {
  auto earliest = *earliest_time(query);
  const double lo = earliest.enclosure().lo;
  if (earliest.makes_late(std::nextafter(lo, 2.0))) return lo;
  throw Error(
      "--as: the distance is first exactly the separation and then above it, expected a query with one right "
      "time");
}

std::string what_was_answered(const Finding& finding) {
  switch (finding.what) {
    case Finding::What::false_negative:
      return "reported no collision";
    case Finding::What::refuted_bound:
      return "reported a collision, although the primitives are farther apart than the bound that it claims";
    case Finding::What::fault:
      return fmt::format("gave no answer ({})", printable(finding.signature));
    case Finding::What::late:
      return "gave a later time as one before which nothing happens";
    case Finding::What::committed:
    case Finding::What::unsafe_step:
      throw Error("--as: found a step that is committed, expected another failure: no single time is right");
    default:
      throw Error(fmt::format("--as: found a finding of the kind {}, expected a failure of a subject",
                              name(finding.what)));
  }
}

std::string_view primitives(Kind kind) {
  switch (kind) {
    case Kind::vertex_triangle:
      return "A vertex (the first point) and a triangle (the other three)";
    case Kind::edge_edge:
      return "Two edges (the first two points, and the last two)";
    case Kind::vertex_vertex:
      return "Two vertices";
    case Kind::vertex_edge:
      return "A vertex (the first point) and an edge (the other two)";
  }
  return "";
}

/// The lines of the comment at the top of the test; each begins with `mark`.
std::string comment(const Finding& finding, std::string_view mark) {
  std::istringstream lines(
      fmt::format("{} (found by nearmiss).\nVertices move linearly from `start` (t = 0) to `end` (t = "
                  "1).\n{}\n{}\n{} {}.\n",
                  primitives(finding.shrunk.kind), what_is_true(finding.shrunk),
                  fmt::format("Also: {}.", to_text(explain(finding.shrunk))), printable(finding.subject),
                  what_was_answered(finding)));
  std::string text;
  for (std::string line; std::getline(lines, line);) text += fmt::format("{} {}\n", mark, line);
  return text;
}

/// The certificate of the truth that the test expects; "" if there is none.
std::string certificate(Finding finding) {
  if (finding.what == Finding::What::late) finding.time = std::nextafter(largest_time(finding.shrunk), 2.0);
  return certificate_of(finding);
}

std::string certificate_comment(const std::string& certificate) {
  if (certificate.empty()) return "";
  return fmt::format(
      "// The next line is a certificate of this, which check.py of nearmiss (tools/certificates/) checks.\n"
      "// {}\n",
      certificate);
}

/// A text as a literal of Python, divided into parts that fit on a line each.
std::string literal_in_lines(std::string_view text) {
  constexpr std::size_t width = 90;
  std::string lines;
  for (; !text.empty(); text.remove_prefix(std::min(width, text.size())))
    lines += fmt::format("    '{}'\n", text.substr(0, width));
  return "(\n" + lines + ")";
}

std::string literal(const mpq_class& value) {
  return mpq_class(value.get_d()) == value ? literal(value.get_d(), Form::python)
                                           : fmt::format("check.Fraction('{}')", value.get_str());
}

std::string certificate_definition(const std::string& certificate) {
  if (certificate.empty()) return "";
  return fmt::format(
      "# Copy check.py, the checker of certificates, beside this file. It is share/nearmiss/check.py of an\n"
      "# installed nearmiss, and tools/certificates/check.py of its sources.\n"
      "import check\n\nCERTIFICATE = {}\n\n\n",
      literal_in_lines(certificate));
}

std::string certificate_assertion(const std::string& certificate) {
  if (certificate.empty()) return "";
  const certificates::Statement proven = certificates::check(certificate);
  const auto truth = [](bool value) { return value ? "True" : "False"; };
  return fmt::format(
      "    # The certificate proves, about exactly these points, what this test expects.\n"
      "    x = tuple(c for point in start + end for c in point)\n"
      "    proven = '{}', x, {}, '{}', {}, {}, {}, {}\n"
      "    assert check.check(CERTIFICATE) == check.Statement(*proven)\n",
      proven.kind, literal(proven.h, Form::python), proven.claim, literal(proven.from), literal(proven.to),
      truth(proven.open), truth(proven.strict));
}

/// A function that the test calls and that the reader of the test must write.
struct Asked {
  std::string name, returns;
  std::string type;  ///< the type that the function returns in C++
};

/// Whether the subject reported a collision with an invalid time.
bool gives_invalid_time(const Finding& finding) {
  return finding.what == Finding::What::fault && is_of_invalid_time(finding.signature);
}

std::vector<Asked> functions(const Finding& finding) {
  if (finding.what == Finding::What::late)
    return {{"time_of_impact", "the time before which nothing happens, by your detector", "double"}};
  const bool is_contact = finding.shrunk.separation == 0;
  std::vector<Asked> all{
      {"detects",
       is_contact ? "whether your detector reports a collision"
                  : "whether your detector reports that the primitives come within the separation",
       "bool"}};
  if (gives_invalid_time(finding))
    all.push_back({"time_of_impact", "the time that your detector gives with this answer", "double"});
  return all;
}

/// The condition that the test asserts; `arguments` are the arguments of every call.
std::string expectation(const Finding& finding, const std::string& arguments, Form language) {
  const bool python = language == Form::python;
  const std::string time = "time_of_impact" + arguments;
  if (finding.what == Finding::What::late)
    return fmt::format("{} <= {}", time, literal(largest_time(finding.shrunk), language));
  const std::string detects = "detects" + arguments;
  const bool collision = collides(finding.shrunk);
  const std::string is_right =
      python ? (collision ? "" : "not ") + detects : fmt::format("{} == {}", detects, collision);
  if (!gives_invalid_time(finding)) return is_right;
  // If the detector reports a collision, the test also asserts that the time is valid, even if the collision
  // is a false positive. If the detector reports no collision, it need not give a time.
  if (python) return fmt::format("{} {} 0 <= {} <= 1", is_right, collision ? "and" : "or", time);
  return collision ? fmt::format("{0} && {1} >= 0 && {1} <= 1", is_right, time)
                   : fmt::format("{0} || ({1} >= 0 && {1} <= 1)", is_right, time);
}

/// A comment that asks the reader to write these functions. In C++, their declarations follow.
std::string request(const std::vector<Asked>& functions, const Query& query, Form language) {
  const bool python = language == Form::python;
  const bool has_separation = query.separation != 0;
  std::string text, declarations;
  for (const Asked& each : functions) {
    const std::string function =
        python ? fmt::format("{}(start, end{})", each.name, has_separation ? ", separation" : "")
               : fmt::format("`{}`", each.name);
    text +=
        fmt::format("{} Write a function {} that returns {}.\n", python ? "#" : "//", function, each.returns);
    declarations +=
        fmt::format("{0} {1}(const double (&start)[{2}][3], const double (&end)[{2}][3]{3});\n", each.type,
                    each.name, vertices(query.kind), has_separation ? ", double separation" : "");
  }
  return python ? text : text + declarations + "\n";
}

}  // namespace

Form parse_form(std::string_view text, std::string_view option) {
  if (text == "case") return Form::case_file;
  if (text == "c++") return Form::cpp;
  if (text == "gtest") return Form::gtest;
  if (text == "python") return Form::python;
  throw Error(fmt::format("{}: found '{}', expected case, c++, gtest or python", option, printable(text)));
}

std::string pasted_test(const Finding& finding, Form language) {
  const Query& query = finding.shrunk;
  const std::string arguments =
      fmt::format("(start, end{})", query.separation != 0 ? ", " + literal(query.separation, language) : "");
  const bool python = language == Form::python;
  const std::string heading = comment(finding, python ? "#" : "//");
  const std::string proof = certificate(finding);
  const std::string_view kind = topology(query.kind).name;
  const std::string expected = expectation(finding, arguments, language);
  const bool gtest = language == Form::gtest;
  const std::string start = points(query, 0, language), end = points(query, 1, language);
  if (python)
    return fmt::format(
        "{}{}{}def test_{}():\n    start = [\n{}    ]\n    end = [\n{}    ]\n{}    assert {}\n", heading,
        request(functions(finding), query, language), certificate_definition(proof), kind, start, end,
        certificate_assertion(proof), expected);
  return fmt::format(
      "{0}{1}{2}{3}{4} {{\n  const double start[{5}][3] = {{\n{6}  }};\n  const double end[{5}][3] = "
      "{{\n{7}  }};\n  {8};\n}}\n",
      heading, certificate_comment(proof), gtest ? "#include <gtest/gtest.h>\n\n" : "",
      request(functions(finding), query, language),
      fmt::format(fmt::runtime(gtest ? "TEST(Ccd, {})" : "bool test_{}()"), kind), vertices(query.kind),
      start, end, fmt::format(fmt::runtime(gtest ? "EXPECT_TRUE({})" : "return {}"), expected));
}

}  // namespace nearmiss::tools
