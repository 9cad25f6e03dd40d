// Some subjects pass a query on, for example to the oracle, if their own algorithm is not sure. These tables
// show which stage decides, by family.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/statistics/statistics.hpp"

namespace nearmiss {

inline constexpr std::size_t decider_count = 4;

/// Names of the deciders in files, in the order in which a subject asks them. A stage or rejection with one
/// of the last three names belongs to that decider; every other stage or rejection belongs to "algorithm".
inline constexpr std::array<std::string_view, decider_count> decider_names{"algorithm", "filter", "finer",
                                                                           "exact"};

/// The queries of a family, of all kinds together, by what decided them.
struct DeciderRow {
  std::string subject;
  std::string family;  ///< "" for all families; a scene is one family with all its steps
  std::array<std::uint64_t, decider_count> queries{};
  std::optional<double> ns_per_query;       ///< nothing if the subject was not timed
  std::map<std::string, double> time_over;  ///< time divided by that of the subject in the key, over the same
                                            ///< families and kinds

  [[nodiscard]] std::uint64_t all() const;
};

/// The rows of each subject for which both its algorithm and another stage decide something: one for all
/// families, then one for each. Times are compared with those of wang and exact, if these are in the
/// statistics.
std::vector<DeciderRow> decider_rows(const Statistics& statistics);

/// A table for each subject; "" without rows.
std::string decider_tables(const Statistics& statistics);

/// A list of the rows.
nlohmann::ordered_json deciders_json(const Statistics& statistics);

}  // namespace nearmiss
