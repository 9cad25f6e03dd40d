// Campaigns that tests save in stores, and changes to these stores.
#pragma once

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <array>
#include <filesystem>
#include <string>

#include "reports/campaign/campaign.hpp"
#include "tests/queries.hpp"

namespace nearmiss::testing {

inline const Query stored_query = falling_edge(0.1, -1.0 / 3);

inline Statistics some_statistics(const std::string& subject) {
  Statistics statistics;
  Counts& counts = statistics.counts[{subject, Kind::edge_edge, "uniform"}];
  counts.add({.verdict = {true, Stage::ve_minimum, 0.5}, .collision = true}, stored_query,
             [] { return "uniform:1:1"; });
  counts.add({.verdict = {true, Stage::vv, 0.5}, .collision = false, .ratio = 0.1}, stored_query,
             [] { return "uniform:1:3"; });
  counts.add({.verdict = Verdict::rejected(Rejection::culled)}, stored_query, [] { return "uniform:1:5"; });
  counts.times.add(Kind::edge_edge, "uniform", {3, 99});
  OracleCounts& oracle = statistics.oracle[{Kind::edge_edge, "uniform"}];
  oracle.queries = 2;
  oracle.collisions = 1;
  oracle.by_stage[2] = 2;
  oracle.near_bounds = 2;
  counts.faults = {0, 1, 2, 3, 4};
  counts.queries += counts.faults_total();
  for (const std::uint64_t time : {100U, 3U, 7000U})
    counts.times.add(time, stored_query, [] { return "slow"; });
  oracle.compared = 1;
  oracle.compared_collisions = 1;
  oracle.missed_by_parity = 1;
  statistics.extremes["mu"] = {
      Extreme::Of::accepting_tolerance, "mu", 1.0 / 3, stored_query, "uniform:1:3", 7};
  statistics.extremes["tau"] = nothing_found(Extreme::Of::keeping_tolerance, "tau");
  statistics.funnels[{"scene:cloth#3", Kind::edge_edge}] = {{1, 2, 3, 4, 5}, 6, 7, 8};
  statistics.simulated[{"scene:sim:cloths", subject, 3}] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  const std::array<std::string, 2> values{"scale=1", "when=at-1"};
  count_answer(statistics.factors, {subject, Kind::edge_edge, "crossed", ""}, values, true, false);
  statistics.versions[{"old", subject, Kind::edge_edge, "uniform"}] = {1, 2, 3, 4};
  statistics.seen[{Finding::What::false_negative, subject, "ee simple-root inside crossing"}] = 5;
  statistics.oracle_disagreements = 3;
  statistics.mismatches_with_recorded_truth = 4;
  return statistics;
}

/// A finding with this provenance. Findings whose provenances have the same length have the same shrunk
/// query.
inline Finding some_finding(const std::string& provenance) {
  return {.what = Finding::What::false_negative,
          .subject = "basic",
          .family = "uniform",
          .query = stored_query,
          .provenance = provenance,
          .signature = "ee simple-root inside crossing",
          .shrunk = with_separation(falling_edge(static_cast<double>(provenance.size()), -1), 0.1),
          .place = 7,
          .time = 0.75,
          .bound = 0.125,
          .certificate = R"({"claim":"meets"})",
          .errors = "first line\n\nthird line\n"};
}

class Database {
 public:
  explicit Database(const std::filesystem::path& file) { sqlite3_open(file.c_str(), &db_); }
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  ~Database() { sqlite3_close(db_); }

  void execute(const std::string& sql) const {
    EXPECT_EQ(sqlite3_exec(db_, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(db_);
  }

 private:
  sqlite3* db_ = nullptr;
};

inline const RunInfo info{{"command", "fuzz"}, {"seed", "1"}};
inline const Shard shard{.index = 2,
                         .count = 5,
                         .cases = 77,
                         .complete = true,
                         .started = "2026-01-02T03:04:05Z",
                         .seconds = 12.5,
                         .environment = {{"cpu", "some"}}};

}  // namespace nearmiss::testing
