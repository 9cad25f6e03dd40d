// The tables of a campaign.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "reports/campaign/campaign.hpp"
#include "reports/store/table.hpp"
#include "reports/text/json.hpp"

namespace nearmiss {

/// The rows that belong to runs. Runs are numbered from 0.
using Shards = std::map<std::pair<std::uint64_t, std::uint64_t>, Shard>;      ///< by run and index
using Findings = std::map<std::pair<std::uint64_t, std::uint64_t>, Finding>;  ///< by run and place in the run
using Pictures =
    std::map<std::pair<std::uint64_t, std::string>, nlohmann::json::object_t>;  ///< by run and step

/// Consecutive findings of a run, from the one at place `first` on.
Findings rows_of(std::uint64_t run, std::span<const Finding> findings, std::uint64_t first = 0);

/// Replaces all counters in a store.
void write_statistics(Save& save, const Statistics& statistics);

/// Writes a campaign to an empty store.
void write_campaign(Save& save, const Campaign& campaign);

/// Reads a campaign. A run whose row was lost has no facts. Throws Error for an invalid value, and passes on
/// exceptions of `read`.
Campaign read_campaign(Reader& read);

}  // namespace nearmiss
