#include "reports/store/salvage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "reports/store/run_tables.hpp"
#include "reports/store/statistics_tables.hpp"
#include "reports/store/version.hpp"
#include "reports/text/shell.hpp"

namespace nearmiss {

namespace {

/// The rows of a table that were lost, in words; "" if none were.
std::string lost(const Salvaged& table) {
  if (!table.rows) return fmt::format("an unknown number of rows of {}", table.table);
  if (table.intact >= *table.rows) return "";
  return fmt::format("{} of {} rows of {}", *table.rows - table.intact, *table.rows, table.table);
}

void mark(std::vector<Run>& runs, const std::string& lost, bool lost_runs) {
  if (runs.empty()) runs.emplace_back();
  for (Run& run : runs) {
    run.info.try_emplace("command", "unknown");
    run.info[salvaged_fact] = "lost " + lost;
    if (lost_runs) run.info[origin_fact] = "partly unknown";
  }
}

/// A signature was seen at least as often as there are findings of it, also if its own row is lost.
void count_findings(Campaign& campaign) {
  std::map<Signature, std::uint64_t> stored;
  for (const Finding& finding : campaign.findings()) ++stored[signature_of(finding)];
  for (const auto& [signature, count] : stored) {
    std::uint64_t& seen = campaign.statistics.seen[signature];
    seen = std::max(seen, count);
  }
}

}  // namespace

Salvage salvage_campaign(const std::filesystem::path& file) {
  return naming(file, [&] {
    SQLite::Database db = open_to_read(file);
    db.exec("PRAGMA writable_schema = ON");  // lets SQLite read a file that was cut off, or a damaged schema
    const SQLite::Transaction one_save(db);  // another process may save meanwhile
    db.exec("PRAGMA schema_version");        // throws if this is no database
    TableReader read = TableReader::salvaging(db);
    Salvage salvage{{read_runs(read), read_statistics(read)}, 0, ""};
    bool lost_runs = false;
    for (const Salvaged& table : read.salvaged()) {
      salvage.rows += table.intact;
      const std::string each = lost(table);
      lost_runs |= !each.empty() && (table.table == "run" || table.table == "shard");
      if (!each.empty()) salvage.lost += (salvage.lost.empty() ? "" : ", ") + each;
    }
    if (salvage.rows == 0) throw Error("found no intact row, so that nothing can be saved");
    if (!salvage.lost.empty()) {
      mark(salvage.campaign.runs, salvage.lost, lost_runs);
      count_findings(salvage.campaign);
    }
    return salvage;
  });
}

std::string advice(const std::filesystem::path& file) {
  try {
    const Salvage salvage = salvage_campaign(file);
    return fmt::format("nearmiss merge NEW.db {} --salvage saves {} rows, without {}",
                       shell_quoted(file.string()), salvage.rows,
                       salvage.lost.empty() ? "any loss" : salvage.lost);
  } catch (const std::exception&) {
    return "nothing can be saved";
  }
}

}  // namespace nearmiss
