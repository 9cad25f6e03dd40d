// Tables that other commands write, and that reports show: how soon nearmiss finds known defects, and what
// CCDs miss in environments.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace nearmiss {

/// A hunt (a search for a known defect of `subject`), and how long the hunt took to find the defect.
struct Hunt {
  std::string subject, way;
  std::string time = {};   ///< time limit of the hunt: "60s"
  std::uint64_t seed = 0;  ///< seed of the queries
  /// The failure that was found, if any. If no failure was found, the members below have no meaning.
  std::optional<std::string> failure = {};  ///< "false-negative", "refuted-bound" or "late"
  double seconds = 0;
  std::uint64_t cases = 0;
  std::string provenance = {};
};

nlohmann::ordered_json hunts_json(const std::vector<Hunt>& hunts);

/// Reads the file that nearmiss power --json writes. Throws Error if it cannot be read or has other content.
std::vector<Hunt> load_hunts(const std::filesystem::path& file);

/// Reads the table that tools/environments writes: results of CCDs in environments. An environment is a
/// compiler, its flags, and the processor's mode of arithmetic. Returns the table as JSON. Each row has a
/// verdict, which says whether the CCD misses no collision ("keeps it"), misses some ("misses"), or gives no
/// answer to some queries ("gives no answer"). Returns "" for an empty table. Throws Error if the file cannot
/// be read or has other content.
std::string load_environments(const std::filesystem::path& file);

}  // namespace nearmiss
