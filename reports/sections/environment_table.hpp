// Which environments keep a CCD's guarantee: compiler, flags and mode of the processor.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nearmiss {

/// The results of a CCD that was compiled and run in one environment.
struct Environment {
  std::string subject, compiler, flags, mode;
  std::uint64_t queries = 0, collisions = 0, missed = 0, false_positives = 0, refuted_bounds = 0, faults = 0;
  std::optional<std::string> first = {};  ///< the first failure, with its query's provenance

  /// The guarantee is that no collision is missed: "keeps it", "misses", or "gives no answer" to some
  /// queries.
  [[nodiscard]] std::string_view verdict() const {
    return missed > 0 ? "misses" : faults > 0 ? "gives no answer" : "keeps it";
  }
};

/// A list with a verdict for each.
nlohmann::ordered_json environments_json(const std::vector<Environment>& environments);

/// Reads the table that tools/environments writes. Throws Error.
std::vector<Environment> load_environments(const std::filesystem::path& file);

}  // namespace nearmiss
