// What decides the queries of a subject that asks others where its own algorithm is not sure, by family.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/statistics.hpp"

namespace nearmiss {

inline constexpr std::size_t decider_count = 4;

/// In the order in which they are asked, as they stand in files. The last three are the stages and rejections of
/// these names, the algorithm is all the rest.
inline constexpr std::array<std::string_view, decider_count> decider_names{"algorithm", "filter", "finer",
                                                                           "exact"};

/// Both kinds together.
struct DeciderRow {
  std::string subject;
  std::string family;  ///< "" for all; of a scene all steps
  std::array<std::uint64_t, decider_count> queries{};
  std::optional<double> ns_per_query;       ///< nothing where it was not timed
  std::map<std::string, double> time_over;  ///< over that of another, for the same families and kinds

  [[nodiscard]] std::uint64_t all() const;
};

/// Of each subject of which both its algorithm and others decide something: all, then each family. Times are
/// over those of wang and exact, where these are there.
std::vector<DeciderRow> decider_rows(const Statistics& statistics);

/// A table for each subject; "" where there is none.
std::string decider_tables(const Statistics& statistics);

/// A list of the rows.
nlohmann::ordered_json deciders_json(const Statistics& statistics);

}  // namespace nearmiss
