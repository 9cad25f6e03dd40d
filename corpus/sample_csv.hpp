// The sample-query CSV format: coordinates as rational numbers, with a recorded truth.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

#include "corpus/readers.hpp"

namespace nearmiss {

/// See read_cases. The folder in `path` determines the kind; errors name `path`.
void read_sample_csv(std::istream& in, const std::filesystem::path& path, const CaseSink& sink);

/// The folder of the files of a kind; nothing for a kind that the format does not have.
std::optional<std::string_view> sample_folder(Kind kind);

/// The eight lines of a query without a separation, of a kind that the format has.
std::string to_sample_csv(const Query& query, bool truth);

}  // namespace nearmiss
