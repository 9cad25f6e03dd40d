// The sample-query CSV format: coordinates as rational numbers, with recorded truths in a column, in a file of
// their own, or without.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

#include "corpus/readers.hpp"

namespace nearmiss {

/// See read_cases. `path` determines the kind; errors name it.
void read_sample_csv(std::istream& in, const std::filesystem::path& path, const CaseSink& sink);

/// The kind of a file's queries is that of its folder, or of the end of its name.
struct SampleNames {
  std::string_view folder, ending;
};
/// Those of a kind; nothing for a kind that the format does not have.
std::optional<SampleNames> sample_names(Kind kind);

/// The file with the truths of a file of queries without a column for them.
std::filesystem::path sample_truths(const std::filesystem::path& csv);

/// The eight lines of a query without a separation, of a kind that the format has, with a column for its truth
/// if it is given.
std::string to_sample_csv(const Query& query, std::optional<bool> truth);

}  // namespace nearmiss
