// Tables of other commands that reports show: how soon hunts find defects, and environments.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nearmiss {

/// One way to hunt for one known defect, and how long it took to find it.
struct Hunt {
  std::string subject, way;
  std::string time = {};   ///< its limit: "60s"
  std::uint64_t seed = 0;  ///< of the queries
  /// The failure that was found, if any; without a failure, the members below are meaningless.
  std::optional<std::string> failure = {};  ///< "false-negative", "refuted-bound" or "late"
  double seconds = 0;
  std::uint64_t cases = 0;
  std::string provenance = {};
};

nlohmann::ordered_json hunts_json(const std::vector<Hunt>& hunts);

/// Reads the file that nearmiss power --json writes. Throws Error.
std::vector<Hunt> load_hunts(const std::filesystem::path& file);

/// The results of a CCD in one environment: compiler, flags, and the processor's mode of arithmetic.
struct Environment {
  std::string subject, compiler, flags, mode;
  std::uint64_t queries = 0, collisions = 0, missed = 0, false_positives = 0, refuted_bounds = 0, faults = 0;
  std::optional<std::string> first = {};  ///< the first failure, with its query's provenance

  /// The guarantee is that no collision is missed. "gives no answer" means that some queries got no answer.
  [[nodiscard]] std::string_view verdict() const {
    return missed > 0 ? "misses" : faults > 0 ? "gives no answer" : "keeps it";
  }
};

/// A list of the environments, each with its verdict.
nlohmann::ordered_json environments_json(const std::vector<Environment>& environments);

/// Reads the table that tools/environments writes. Throws Error.
std::vector<Environment> load_environments(const std::filesystem::path& file);

}  // namespace nearmiss
