// The store of a campaign: one SQLite file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "ccd/query/error.hpp"
#include "reports/campaign/campaign.hpp"

namespace nearmiss {

/// Thrown if another process has locked a store for longer than a save waits. Nothing was saved.
class StoreIsLocked : public Error {
 public:
  using Error::Error;
};

/// The file to which a shard (one machine's part of a run) saves its results while it runs. Every save is one
/// transaction: the file gets all results of the save, or none of them. Earlier saves survive a full disk, an
/// interrupt or a kill. Only one process at a time writes a file; others may read it meanwhile.
class Store {
 public:
  /// Whether the file is a store that can be resumed. If a process is killed while it makes a store, it may
  /// leave a database without tables, which is not yet a store.
  static bool exists(const std::filesystem::path& file);
  /// Removes a store that no process has open, and the logs that SQLite leaves beside the store if the disk
  /// is full.
  static void remove(const std::filesystem::path& file);
  /// Makes a new file for a run and its shard. Throws Error if the file exists, or cannot be made.
  Store(const std::filesystem::path& file, const RunInfo& info, const Shard& shard);
  /// Opens a file to resume its run. Throws Error if the file is not a store with exactly one run and one
  /// shard, or if another process writes the file. If `found` is given, it receives the contents of the file.
  /// If `check` is given, it is called before each row is read, and may end the reading by an exception.
  explicit Store(const std::filesystem::path& file, Campaign* found = nullptr,
                 const std::function<void()>& check = {});
  ~Store();

  /// Replaces the file's statistics and shard, and adds the findings that are new since the last save. If the
  /// file cannot be written, throws Error (for example StoreIsLocked) and leaves the file unchanged.
  void save(const Statistics& statistics, const Shard& shard, std::span<const Finding> new_findings);

  /// Replaces all findings. Throws Error as `save` does.
  void replace(std::span<const Finding> findings);

  /// Adds a picture. Throws Error as `save` does.
  void add(const ScenePicture& picture);

 private:
  struct Database;
  std::unique_ptr<Database> database_;
};

/// Reads a whole campaign. Throws Error if the file is missing, is not a store, has another version, or is
/// damaged.
Campaign load_campaign(const std::filesystem::path& file);

/// Reads several files as one campaign. Throws Error as load_campaign and merge_campaigns do.
Campaign load_campaigns(std::span<const std::filesystem::path> files);

/// The intact part of a store.
struct Salvage {
  Campaign campaign;       ///< if anything was lost, each run has the fact `salvaged_fact`
  std::uint64_t rows = 0;  ///< number of intact rows
  std::string lost;        ///< such as "3 of 20 rows of counts"; "" if nothing was lost
};

/// Reads all intact rows of a store, which are the rows that match their checksums. Does not check the
/// version number in the file, because the number may be damaged. Rows of a store of another version do not
/// count as intact, because the checksums include the version. Throws Error if the file cannot be read, or
/// has no intact row.
Salvage salvage_campaign(const std::filesystem::path& file);

/// Writes a campaign to a new file. Throws Error if the file already exists or cannot be written. If writing
/// fails, no part of the file remains.
void write_campaign(const Campaign& campaign, const std::filesystem::path& file);

}  // namespace nearmiss
