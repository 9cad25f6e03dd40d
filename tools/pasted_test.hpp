// Findings as tests that the maintainer of a CCD can paste into their own project.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "reports/statistics/finding.hpp"

namespace nearmiss::tools {

/// What `nearmiss shrink` prints: a case, or a test in a language.
enum class Form : std::uint8_t { case_file, cpp, gtest, python };

/// Parses "case", "c++", "gtest" or "python". Throws Error that names the option.
Form parse_form(std::string_view text, std::string_view option);

/// A test of one finding, as source code that needs nothing but a function `detects` of the maintainer.
/// A comment says what the subject answered and what is true. The numbers are exact. In C++17:
///
///     bool detects(const double (&start)[4][3], const double (&end)[4][3]);  // adapt this
///     bool test_vertex_triangle();  // whether `detects` gives the right answer
///
/// For GoogleTest, it is `TEST(Ccd, vertex_triangle)` instead. A comment contains the certificate of what the test expects (certificate_of), if there is one. The test in
/// Python checks it first, with check.py (tools/certificates/).
///
/// In Python, the test is `test_vertex_triangle()`, which asserts that the answer is right, and the points
/// are lists. The name is that of the kind, such as test_edge_edge. A query with a separation adds `double
/// separation` to the arguments. For a late time, the maintainer's function is `double time_of_impact` with
/// the same arguments, and must not return a time after t*. For an invalid time, both functions are needed,
/// and a collision must have a time in [0, 1]. `language` must not be case_file. Throws Error for a finding of
/// the oracle, for which the truth is not known, and for a late time if the distance first touches the
/// separation without falling below it.
std::string pasted_test(const Finding& finding, Form language);

}  // namespace nearmiss::tools
