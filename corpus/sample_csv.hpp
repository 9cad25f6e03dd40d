// The sample-query CSV format: coordinates as rational numbers. Recorded truths are in a column of the file,
// in a separate file, or absent.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

#include "corpus/readers.hpp"

namespace nearmiss {

/// Reads the *.csv format of read_cases. `path` determines the kind of the queries, and errors name `path`.
void read_sample_csv(std::istream& in, const std::filesystem::path& path, const CaseSink& sink);

/// The name of a folder, and the end of a file's name. Either of the two determines the kind of the queries
/// in a file.
struct SampleNames {
  std::string_view folder, ending;
};
/// The names that the format has for a kind; nothing if the format has no queries of this kind.
std::optional<SampleNames> sample_names(Kind kind);

/// The file that has the truths of the queries in `csv` if `csv` has no column for truths.
std::filesystem::path sample_truths(const std::filesystem::path& csv);

/// The eight lines of a query. The query's separation must be 0, and the format must have the query's kind
/// (sample_names). The lines have a column for the truth if `truth` is given.
std::string to_sample_csv(const Query& query, std::optional<bool> truth);

}  // namespace nearmiss
