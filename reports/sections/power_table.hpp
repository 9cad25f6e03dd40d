// The power of detection: how long each way to hunt took to find each known defect.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace nearmiss {

/// One way to hunt for one defect.
struct Hunt {
  std::string subject, way;
  /// The failure that was found, if any; without a failure, the members below are meaningless.
  std::optional<std::string> failure = {};  ///< "false-negative", "refuted-bound" or "late"
  double seconds = 0;
  std::uint64_t cases = 0;
  std::string provenance = {};
};

nlohmann::ordered_json hunts_json(const std::vector<Hunt>& hunts);

/// Reads the file that nearmiss power --json writes. Throws Error.
std::vector<Hunt> load_hunts(const std::filesystem::path& file);

}  // namespace nearmiss
