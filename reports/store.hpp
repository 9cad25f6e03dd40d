// The store of a campaign: one SQLite file.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "reports/statistics.hpp"

namespace nearmiss {

/// A campaign's file while it runs. Every save is one transaction: wholly there or not at all, and what was
/// saved before stays whatever happens (a full disk, an interrupt, a kill).
class Store {
 public:
  /// Makes a new file. Throws Error where there is one already or it cannot be made.
  Store(const std::filesystem::path& file, std::span<const RunInfo> runs);
  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;
  ~Store();

  /// Replaces the statistics by the campaign's so far and adds what was found since the last save.
  /// Throws Error; then the file holds what it held before.
  void save(const Statistics& statistics, std::span<const Finding> new_findings);

 private:
  struct Database;
  std::unique_ptr<Database> database_;
};

/// Reads a whole campaign. Throws Error where the file is missing, is no store, or is of another version.
Campaign load_campaign(const std::filesystem::path& file);

/// Several campaigns as one: counters add up, findings are united, of those that are shrunk to the same query
/// one, runs stand side by side in their own order. The result does not depend on the order of the inputs.
Campaign merge_campaigns(std::span<const Campaign> campaigns);

/// Writes a campaign to a new file, whole or not at all. Throws Error where there is one already.
void write_campaign(const Campaign& campaign, const std::filesystem::path& file);

}  // namespace nearmiss
