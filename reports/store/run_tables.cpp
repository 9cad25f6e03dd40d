#include "reports/store/run_tables.hpp"

#include <map>

#include "reports/store/table.hpp"

namespace nearmiss {

namespace {

/// A row of a table that belongs to a run.
template <class Content>
struct OfRun {
  std::uint64_t run = 0;
  Content content = {};
};

template <class Content>
Column<OfRun<Content>> run_column() {
  return column<OfRun<Content>>(
      "run", [](auto& row) -> auto& { return row.run; });
}

template <class Content, class Member>
Column<OfRun<Content>> content_column(std::string name, Member Content::*member) {
  return column<OfRun<Content>>(
      std::move(name), [member](auto& row) -> auto& { return row.content.*member; });
}

using RunRow = OfRun<RunInfo>;
using ShardRow = OfRun<Shard>;
using FindingRow = OfRun<Finding>;
using PictureRow = OfRun<ScenePicture>;

Table<RunRow> runs() {
  return {"run",
          "PRIMARY KEY (run), UNIQUE (info)",
          "run",
          {run_column<RunInfo>(), column<RunRow>(
                                      "info", [](RunRow & row) -> auto& { return row.content; })}};
}

Table<ShardRow> shards() {
  return {"shard",
          "PRIMARY KEY (run, \"index\"), FOREIGN KEY (run) REFERENCES run",
          "run, \"index\"",
          {run_column<Shard>(), content_column("index", &Shard::index),
           content_column("count", &Shard::count), content_column("cases", &Shard::cases),
           content_column("complete", &Shard::complete), content_column("started", &Shard::started),
           content_column("seconds", &Shard::seconds), content_column("environment", &Shard::environment)}};
}

Table<FindingRow> findings() {
  return {"finding",
          "FOREIGN KEY (run) REFERENCES run",
          "rowid",
          {run_column<Finding>(), content_column("place", &Finding::place),
           content_column("what", &Finding::what), content_column("subject", &Finding::subject),
           content_column("family", &Finding::family), content_column("query", &Finding::query),
           content_column("provenance", &Finding::provenance), content_column("ratio", &Finding::ratio),
           content_column("signature", &Finding::signature), content_column("shrunk", &Finding::shrunk),
           content_column("is_shrunk", &Finding::is_shrunk)}};
}

Table<PictureRow> pictures() {
  return {"picture",
          "PRIMARY KEY (run, step), FOREIGN KEY (run) REFERENCES run",
          "run, step",
          {run_column<ScenePicture>(), content_column("step", &ScenePicture::step),
           content_column("picture", &ScenePicture::json)}};
}

template <class Content>
std::vector<OfRun<Content>> rows_of(std::uint64_t run, std::span<const Content> contents) {
  std::vector<OfRun<Content>> rows;
  for (const Content& each : contents) rows.push_back({run, each});
  return rows;
}

}  // namespace

void make_run_tables(SQLite::Database& db) {
  runs().make(db);
  shards().make(db);
  findings().make(db);
  pictures().make(db);
}

void write_run(SQLite::Database& db, std::uint64_t run, const RunInfo& info) {
  runs().write(db, {{run, info}});
}

void write_shard(SQLite::Database& db, std::uint64_t run, const Shard& shard) {
  shards().write(db, {{run, shard}});
}

void write_findings(SQLite::Database& db, std::uint64_t run, std::span<const Finding> some) {
  findings().write(db, rows_of(run, some));
}

void replace_findings(SQLite::Database& db, std::uint64_t run, std::span<const Finding> all) {
  db.exec("DELETE FROM finding");
  write_findings(db, run, all);
}

void write_pictures(SQLite::Database& db, std::uint64_t run, std::span<const ScenePicture> some) {
  pictures().write(db, rows_of(run, some));
}

std::vector<Run> read_runs(SQLite::Database& db) {
  std::vector<Run> all;
  std::map<std::uint64_t, std::size_t> index;  // position of each run in `all`
  runs().read(db, [&](RunRow&& row) {
    index[row.run] = all.size();
    all.push_back({std::move(row.content), {}, {}});
  });
  shards().read(db,
                [&](ShardRow&& row) { all.at(index.at(row.run)).shards.push_back(std::move(row.content)); });
  findings().read(
      db, [&](FindingRow&& row) { all.at(index.at(row.run)).findings.push_back(std::move(row.content)); });
  pictures().read(db, [&](PictureRow&& row) {
    row.content.json = nlohmann::json::parse(row.content.json).dump();  // throws if it is not JSON
    all.at(index.at(row.run)).pictures.push_back(std::move(row.content));
  });
  return all;
}

}  // namespace nearmiss
