// Findings as tests that the maintainer of a CCD can paste into their own project.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "reports/statistics/finding.hpp"

namespace nearmiss::tools {

/// The language of a pasted test.
enum class Language : std::uint8_t { cpp, python };

/// Parses "c++" or "python". Throws Error that names the option.
Language parse_language(std::string_view text, std::string_view option);

/// A test of one finding, as source code that needs nothing but a function `detects` of the maintainer. A comment says
/// what the subject answered and what is true. The 24 numbers are exact. C++17:
///
///     bool detects(const double (&start)[4][3], const double (&end)[4][3]);  // adapt this
///     bool test_vertex_triangle();  // whether `detects` gives the right answer
///
/// In Python, the test is `test_vertex_triangle()`, which asserts it, and the points are lists. For a pair of edges, its
/// name is test_edge_edge. Throws Error for a finding of the oracle, which shows no truth.
std::string pasted_test(const Finding& finding, Language language);

}  // namespace nearmiss::tools
