// The sample-query CSV format: coordinates as rational numbers, with a recorded truth.
#pragma once

#include <filesystem>
#include <iosfwd>

#include "corpus/readers.hpp"

namespace nearmiss {

/// See read_cases. The folder in `path` determines the kind; errors name `path`.
void read_sample_csv(std::istream& in, const std::filesystem::path& path, const CaseSink& sink);

}  // namespace nearmiss
