// Reading of files and folders of cases, in every format there is.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>

#include "corpus/case.hpp"

namespace nearmiss {

/// Takes one case at a time, so that a file of any length can be read.
using CaseSink = std::function<void(Case&&)>;

/// Reads a file, or a folder with all below it in the order of their paths, by the file's name:
///  - *.case: one case (case.hpp);
///  - *.csv: sample queries, eight rows of a query: x y z as rational numbers (numerator, denominator),
///  truth; the
///    kind is in the name of the folder, edge-edge or vertex-face. A coordinate must be a double exactly;
///  - *.vt, *.ee: one query a line, 24 numbers; '#' starts a comment.
/// In a folder other files are passed over. Throws Error with file and line; also for a file that is empty,
/// is of none of these formats or cannot be read, and for a folder without a case.
void read_cases(const std::filesystem::path& path, const CaseSink& sink);

/// Reads a stream of one query a line. `name` stands for the file in messages. Throws Error.
void read_query_lines(std::istream& in, Kind kind, const std::string& name, const CaseSink& sink);

}  // namespace nearmiss
