#include "reports/store/campaign_tables.hpp"

namespace nearmiss {

namespace {

using nlohmann::json;

/// Calls `use` with the name and the rows of each table of counters.
template <class SomeStatistics, class Use>
void for_each_table(SomeStatistics& statistics, const Use& use) {
  use("counts", statistics.counts);
  use("oracle", statistics.oracle);
  use("funnel", statistics.funnels);
  use("simulated", statistics.simulated);
  use("factor", statistics.factors);
  use("version", statistics.versions);
  use("seen", statistics.seen);
  use("extreme", statistics.extremes);
}

Statistics read_statistics(Reader& read) {
  std::map<int, Statistics> whole;
  read("campaign", whole);
  Statistics statistics = std::move(whole[0]);
  for_each_table(statistics, [&](const char* table, auto& rows) { read(table, rows); });
  return statistics;
}

std::vector<Run> read_runs(Reader& read) {
  std::map<std::uint64_t, RunInfo> infos;
  Shards shards;
  Findings findings;
  Pictures pictures;
  read("run", infos);
  read("shard", shards);
  read("finding", findings);
  read("picture", pictures);
  std::map<std::uint64_t, Run> runs;
  for (auto& [run, info] : infos) runs[run].info = std::move(info);
  for (auto& [key, shard] : shards) runs[key.first].shards.push_back(std::move(shard));
  for (auto& [key, finding] : findings) runs[key.first].findings.push_back(std::move(finding));
  for (auto& [key, picture] : pictures)
    runs[key.first].pictures.push_back({key.second, json_text(json(std::move(picture)))});
  std::vector<Run> all;
  for (auto& [number, run] : runs) all.push_back(std::move(run));
  return all;
}

}  // namespace

Findings rows_of(std::uint64_t run, std::span<const Finding> findings, std::uint64_t first) {
  Findings rows;
  for (const Finding& each : findings) rows.emplace(std::pair{run, first++}, each);
  return rows;
}

void write_statistics(Save& save, const Statistics& statistics) {
  Statistics whole;
  merge_counters(whole, statistics);
  save.replace("campaign", std::map<int, Statistics>{{0, whole}});
  for_each_table(statistics, [&](const char* table, const auto& rows) { save.replace(table, rows); });
}

void write_campaign(Save& save, const Campaign& campaign) {
  std::map<std::uint64_t, RunInfo> infos;
  Shards shards;
  Findings findings;
  Pictures pictures;
  for (const Run& run : campaign.runs) {
    const std::uint64_t number = infos.size();
    infos.emplace(number, run.info);
    for (const Shard& shard : run.shards) shards.emplace(std::pair{number, shard.index}, shard);
    findings.merge(rows_of(number, run.findings));
    for (const ScenePicture& picture : run.pictures)
      pictures.emplace(std::pair{number, picture.step}, json::parse(picture.json));
  }
  save.add("run", infos);
  save.add("shard", shards);
  save.add("finding", findings);
  save.add("picture", pictures);
  write_statistics(save, campaign.statistics);
}

Campaign read_campaign(Reader& read) {
  std::vector<Run> runs = read_runs(read);
  return {std::move(runs), read_statistics(read)};
}

}  // namespace nearmiss
