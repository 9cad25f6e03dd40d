// Saves the intact part of a damaged store.
#pragma once

#include <filesystem>
#include <string>

#include "reports/campaign/campaign.hpp"

namespace nearmiss {

/// The intact part of a store.
struct Salvage {
  Campaign campaign;       ///< each run has the fact `salvaged_fact`, if anything was lost
  std::uint64_t rows = 0;  ///< number of intact rows
  std::string lost;        ///< such as "3 of 20 rows of counts"; "" if nothing was lost
};

/// Reads all intact rows of a store. A row is intact if it matches its checksum. Throws Error if the file cannot be
/// read, or has no intact row. The file's version is not looked at, because it may be damaged; a store of another version
/// has no intact row.
Salvage salvage_campaign(const std::filesystem::path& file);

/// A clause that says how to salvage a store, and how much of it.
std::string advice(const std::filesystem::path& file);

}  // namespace nearmiss
