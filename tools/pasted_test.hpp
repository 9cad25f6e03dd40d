// Findings as tests that the maintainer of a CCD can paste into their own project.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "ccd/subjects/subject.hpp"
#include "reports/statistics/finding.hpp"

namespace nearmiss::tools {

/// What `nearmiss shrink` prints: a case, or a test in a language.
enum class Form : std::uint8_t { case_file, cpp, python };

/// Parses "case", "c++" or "python". Throws Error that names the option.
Form parse_form(std::string_view text, std::string_view option);

/// A test of one finding of a subject with this sort of time, as source code that needs nothing but a function `detects` of
/// the maintainer. A comment says what the subject answered and what is true. The 24 numbers are exact. C++17:
///
///     bool detects(const double (&start)[4][3], const double (&end)[4][3]);  // adapt this
///     bool test_vertex_triangle();  // whether `detects` gives the right answer
///
/// In Python, the test is `test_vertex_triangle()`, which asserts it, and the points are lists. For a pair of edges, its
/// name is test_edge_edge. A query with a separation adds `double separation` to the arguments. If a time is late, the function
/// is `double time_of_impact` with the same arguments, and must not give a time after t*. If an answer is invalid and the
/// subject gives times, both functions are needed, and a collision must have a time in [0, 1]. `language` is not case_file.
/// Throws Error for a finding of the oracle, which shows no truth, and for a late time behind a distance of exactly the
/// separation.
std::string pasted_test(const Finding& finding, TimeSort sort, Form language);

}  // namespace nearmiss::tools
