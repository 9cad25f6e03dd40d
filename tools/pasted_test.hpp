// Findings as tests that the maintainer of a CCD can paste into their own project.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "reports/statistics/finding.hpp"

namespace nearmiss::tools {

/// The forms in which `nearmiss shrink` prints a finding: a case, or a test in some language.
enum class Form : std::uint8_t { case_file, cpp, gtest, python };

/// Parses "case", "c++", "gtest" or "python". Throws Error, with the name of the option, for any other text.
Form parse_form(std::string_view text, std::string_view option);

/// A test of one finding, as source code that needs only a function `detects`, which the maintainer writes.
/// A comment says what the subject answered and what is true. The numbers are exact. In C++17:
///
///     bool detects(const double (&start)[4][3], const double (&end)[4][3]);  // adapt this
///     bool test_vertex_triangle();  // whether `detects` gives the right answer
///
/// For GoogleTest, the test is `TEST(Ccd, vertex_triangle)`. If the truth that the test expects has a
/// certificate (certificate_of), a comment contains the certificate.
///
/// In Python, the test is `test_vertex_triangle()`, which asserts that the answer is right. The points are
/// lists. The test first checks the certificate with check.py (tools/certificates/).
///
/// A test is named after the kind of its query, as in test_edge_edge. For a query with a separation,
/// `detects` has the further argument `double separation`. If the subject gave a late time, the maintainer
/// writes, instead of `detects`, a function `double time_of_impact` with the same arguments, which must not
/// return a time after t*, the exact earliest time. If the subject gave an invalid time, the maintainer
/// writes both functions, and a collision must have a time in [0, 1].
///
/// `language` must not be case_file. Throws Error for a finding about the oracle, because the truth is not
/// known. Throws Error for a late time if the distance does not fall below the separation right after t*.
std::string pasted_test(const Finding& finding, Form language);

}  // namespace nearmiss::tools
