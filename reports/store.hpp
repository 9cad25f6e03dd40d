// The store of a campaign: one SQLite file.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "reports/campaign.hpp"

namespace nearmiss {

/// The file of one run while it goes on. Every save is one transaction: wholly there or not at all, and what
/// was saved before stays whatever happens (a full disk, an interrupt, a kill). One process at a time writes
/// a file, others may read it meanwhile.
class Store {
 public:
  /// Makes a new file. Throws Error where there is one already or it cannot be made.
  Store(const std::filesystem::path& file, const RunInfo& info, const Part& part);
  /// Whether there is a store to go on with. A kill during the creation of a store leaves none, but perhaps a database
  /// without tables, which a new store replaces.
  static bool exists(const std::filesystem::path& file);
  /// Goes on with a file. Throws Error where it is no store of one part of one run, or another process writes
  /// it.
  explicit Store(const std::filesystem::path& file);
  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;
  ~Store();

  /// Replaces the statistics and the part by those so far and adds what was found since the last save.
  /// Throws Error; then the file holds what it held before.
  void save(const Statistics& statistics, const Part& part, std::span<const Finding> new_findings);

  /// Adds a picture. Throws Error likewise.
  void add(const ScenePicture& picture);

 private:
  struct Database;
  std::unique_ptr<Database> database_;
};

/// Reads a whole campaign. Throws Error where the file is missing, is no store, or is of another version.
Campaign load_campaign(const std::filesystem::path& file);

/// Reads several, as one. Throws Error also as merge_campaigns does.
Campaign load_campaigns(std::span<const std::filesystem::path> files);

/// Writes a campaign to a new file, whole or not at all. Throws Error where there is one already.
void write_campaign(const Campaign& campaign, const std::filesystem::path& file);

}  // namespace nearmiss
