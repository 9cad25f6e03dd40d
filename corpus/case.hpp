// A case: a query worth keeping, as one text file.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// A query with its origin and the reason to keep it.
struct Case {
  std::string name;  ///< the source file, with the number of the line if the file has several cases
  Query query;
  std::optional<bool> truth = {};  ///< whether the query is a collision, if the case records this
  std::string why = {};            ///< why the query is kept; may have several lines
  std::string provenance = {};     ///< origin of the query, such as "planted:1:42" (family, seed, index)
};

/// Writes a case in the format of *.case files. The lines of `why` come first, as comments. Each point is a
/// line with three numbers. A number is written as a decimal if the decimal is exact, otherwise as a hex
/// float. The kind and its points are required; `truth`, `separation` and `provenance` may be missing:
///
///     # Two roots: parity is even, yet it is a collision.
///     kind ee
///     truth 1
///     provenance by hand
///     x0 0 1 0   (x0 .. x3 at t = 0, then y0 .. y3 at t = 1)
std::string to_text(const Case& each);

/// Parses the format of to_text. Throws an Error that names the file and the line.
Case parse_case(std::istream& in, const std::string& file);

/// Writes a case to a file in the format of to_text. The file is written whole or not at all. Throws Error if
/// the file cannot be written.
void write_case(const Case& each, const std::filesystem::path& file);

}  // namespace nearmiss
