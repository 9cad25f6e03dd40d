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
struct FindingRow : OfRun<Finding> {
  std::uint64_t number = 0;  ///< its place among all findings
};
using PictureRow = OfRun<ScenePicture>;

Table<RunRow> runs() {
  return {"run",
          "PRIMARY KEY (run), UNIQUE (info)",
          {"run"},
          {run_column<RunInfo>(), column<RunRow>(
                                      "info", [](RunRow & row) -> auto& { return row.content; })}};
}

Table<ShardRow> shards() {
  return {"shard",
          "PRIMARY KEY (run, \"index\"), FOREIGN KEY (run) REFERENCES run",
          {"run", "index"},
          {run_column<Shard>(), content_column("index", &Shard::index),
           content_column("count", &Shard::count), content_column("cases", &Shard::cases),
           content_column("complete", &Shard::complete), content_column("started", &Shard::started),
           content_column("seconds", &Shard::seconds), content_column("environment", &Shard::environment)}};
}

Table<FindingRow> findings() {
  const auto member = [](std::string name, auto pointer) {
    return column<FindingRow>(
        std::move(name), [pointer](FindingRow & row) -> auto& { return row.content.*pointer; });
  };
  return {
      "finding",
      "PRIMARY KEY (number), FOREIGN KEY (run) REFERENCES run",
      {"number"},
      {column<FindingRow>(
           "number", [](FindingRow & row) -> auto& { return row.number; }),
       column<FindingRow>(
           "run", [](FindingRow & row) -> auto& { return row.run; }),
       member("place", &Finding::place), member("what", &Finding::what), member("subject", &Finding::subject),
       member("family", &Finding::family), member("query", &Finding::query),
       member("provenance", &Finding::provenance), member("ratio", &Finding::ratio),
       member("signature", &Finding::signature), member("shrunk", &Finding::shrunk),
       member("time", &Finding::time), member("is_shrunk", &Finding::is_shrunk),
       member("query_class", &Finding::query_class), member("simplest", &Finding::simplest),
       member("simplest_class", &Finding::simplest_class), member("broken_since", &Finding::broken_since)}};
}

Table<PictureRow> pictures() {
  return {"picture",
          "PRIMARY KEY (run, step), FOREIGN KEY (run) REFERENCES run",
          {"run", "step"},
          {run_column<ScenePicture>(), content_column("step", &ScenePicture::step),
           content_column("picture", &ScenePicture::json)}};
}

constexpr std::uint64_t only_run = 0;

void add_findings(SQLite::Database& db, std::uint64_t run, std::span<const Finding> some) {
  if (some.empty()) return;
  std::uint64_t number = read_contents(db, findings().name).rows;
  std::vector<FindingRow> rows;
  for (const Finding& each : some) rows.push_back({{run, each}, ++number});
  findings().add(db, std::move(rows));
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

void write_runs(SQLite::Database& db, std::span<const Run> some) {
  std::uint64_t number = 0;
  for (const Run& run : some) {
    runs().add(db, {{number, run.info}});
    shards().add(db, rows_of(number, std::span(run.shards)));
    add_findings(db, number, run.findings);
    pictures().add(db, rows_of(number, std::span(run.pictures)));
    ++number;
  }
}

void replace_shard(SQLite::Database& db, const Shard& shard) { shards().replace(db, {{only_run, shard}}); }

void write_findings(SQLite::Database& db, std::span<const Finding> some) { add_findings(db, only_run, some); }

void write_picture(SQLite::Database& db, const ScenePicture& picture) {
  pictures().add(db, {{only_run, picture}});
}

void replace_findings(SQLite::Database& db, std::span<const Finding> all) {
  findings().clear(db);
  write_findings(db, all);
}

std::vector<Run> read_runs(TableReader& read) {
  std::map<std::uint64_t, Run> by_number;
  read(runs(), [&](RunRow&& row) { by_number[row.run].info = std::move(row.content); });
  read(shards(), [&](ShardRow&& row) { by_number[row.run].shards.push_back(std::move(row.content)); });
  read(findings(), [&](FindingRow&& row) { by_number[row.run].findings.push_back(std::move(row.content)); });
  read(pictures(), [&](PictureRow&& row) {
    row.content.json = nlohmann::json::parse(row.content.json).dump();  // throws if it is not JSON
    by_number[row.run].pictures.push_back(std::move(row.content));
  });
  std::vector<Run> all;
  for (auto& [number, run] : by_number) all.push_back(std::move(run));
  return all;
}

}  // namespace nearmiss
