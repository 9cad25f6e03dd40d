#include "reports/store/statistics_tables.hpp"

#include "reports/store/table.hpp"

namespace nearmiss {

namespace {

using KindAndFamily = std::pair<Kind, std::string>;
using StepAndKind = std::pair<std::string, Kind>;

/// A row for an entry of a map in Statistics.
template <class Key, class Value>
struct MapRow {
  Key key;
  Value value = {};
};

using CountsRow = MapRow<CountsKey, Counts>;
using OracleRow = MapRow<KindAndFamily, OracleCounts>;
using FunnelRow = MapRow<StepAndKind, Funnel>;
using FactorRow = MapRow<FactorKey, FactorCounts>;
using VersionRow = MapRow<VersionKey, VersionCounts>;
using SeenRow = MapRow<Signature, std::uint64_t>;

template <class Row, class Member, class Key>
Column<Row> key_column(std::string name, Member Key::*member) {
  return column<Row>(
      std::move(name), [member](Row & row) -> auto& { return row.key.*member; });
}

/// A table with these columns for the key, and a column for each counter.
template <class Row>
Table<Row> counters_table(std::string name, const std::string& key, std::vector<Column<Row>> columns) {
  using Owner = decltype(Row::value);
  add_counters<Row, Owner>(
      columns, "", [](Row & row) -> auto& { return row.value; });
  return {std::move(name), "PRIMARY KEY (" + key + ")", {}, std::move(columns)};
}

Table<CountsRow> counts() {
  return counters_table<CountsRow>(
      "counts", "subject, kind, family",
      {key_column<CountsRow>("subject", &CountsKey::subject), key_column<CountsRow>("kind", &CountsKey::kind),
       key_column<CountsRow>("family", &CountsKey::family)});
}

Table<OracleRow> oracle() {
  return counters_table<OracleRow>("oracle", "kind, family",
                                   {key_column<OracleRow>("kind", &KindAndFamily::first),
                                    key_column<OracleRow>("family", &KindAndFamily::second)});
}

Table<FunnelRow> funnels() {
  return counters_table<FunnelRow>("funnel", "step, kind",
                                   {key_column<FunnelRow>("step", &StepAndKind::first),
                                    key_column<FunnelRow>("kind", &StepAndKind::second)});
}

Table<FactorRow> factors() {
  return counters_table<FactorRow>(
      "factor", "subject, kind, family, factor_values",
      {key_column<FactorRow>("subject", &FactorKey::subject), key_column<FactorRow>("kind", &FactorKey::kind),
       key_column<FactorRow>("family", &FactorKey::family),
       key_column<FactorRow>("factor_values", &FactorKey::values)});
}

Table<VersionRow> versions() {
  return counters_table<VersionRow>(
      "version", "before, after, kind, family",
      {key_column<VersionRow>("before", &VersionKey::before),
       key_column<VersionRow>("after", &VersionKey::after), key_column<VersionRow>("kind", &VersionKey::kind),
       key_column<VersionRow>("family", &VersionKey::family)});
}

Table<SeenRow> seen() {
  return {"seen",
          "PRIMARY KEY (what, subject, signature)",
          {},
          {key_column<SeenRow>("what", &Signature::what), key_column<SeenRow>("subject", &Signature::subject),
           key_column<SeenRow>("signature", &Signature::text),
           column<SeenRow>(
               "times", [](SeenRow & row) -> auto& { return row.value; })}};
}

Table<Extreme> extremes() {
  const auto member = [](std::string name, auto pointer) {
    return column<Extreme>(
        std::move(name), [pointer](Extreme & row) -> auto& { return row.*pointer; });
  };
  return {"extreme",
          "PRIMARY KEY (name)",
          {},
          {member("name", &Extreme::name), member("of", &Extreme::of), member("value", &Extreme::value),
           member("query", &Extreme::query), member("provenance", &Extreme::provenance),
           member("queries", &Extreme::queries)}};
}

/// The counters of the campaign as a whole: one row.
struct CampaignRow {
  std::uint64_t id = 0;
  Statistics statistics;
};

Table<CampaignRow> campaign() {
  std::vector<Column<CampaignRow>> columns{column<CampaignRow>(
      "id", [](CampaignRow & row) -> auto& { return row.id; })};
  add_counters<CampaignRow, Statistics>(
      columns, "", [](CampaignRow & row) -> auto& { return row.statistics; });
  return {"campaign", "PRIMARY KEY (id)", {}, std::move(columns)};
}

template <class Key, class Value>
void write_map(SQLite::Database& db, const Table<MapRow<Key, Value>>& table,
               const std::map<Key, Value>& map) {
  std::vector<MapRow<Key, Value>> rows;
  for (const auto& [key, value] : map) rows.push_back({key, value});
  table.replace(db, std::move(rows));
}

template <class Key, class Value>
void read_map(TableReader& read, const Table<MapRow<Key, Value>>& table, std::map<Key, Value>& map) {
  read(table, [&](MapRow<Key, Value>&& row) { map.emplace(std::move(row.key), std::move(row.value)); });
}

}  // namespace

void make_statistics_tables(SQLite::Database& db) {
  counts().make(db);
  oracle().make(db);
  funnels().make(db);
  factors().make(db);
  versions().make(db);
  seen().make(db);
  extremes().make(db);
  campaign().make(db);
}

void write_statistics(SQLite::Database& db, const Statistics& statistics) {
  write_map(db, counts(), statistics.counts);
  write_map(db, oracle(), statistics.oracle);
  write_map(db, funnels(), statistics.funnels);
  write_map(db, factors(), statistics.factors);
  write_map(db, versions(), statistics.versions);
  write_map(db, seen(), statistics.seen);
  std::vector<Extreme> rows;
  for (const auto& [name, each] : statistics.extremes) rows.push_back(each);
  extremes().replace(db, std::move(rows));
  CampaignRow whole;
  merge_counters(whole.statistics, statistics);
  campaign().replace(db, {std::move(whole)});
}

Statistics read_statistics(TableReader& read) {
  Statistics statistics;
  read(campaign(), [&](CampaignRow&& row) { statistics = std::move(row.statistics); });
  read_map(read, counts(), statistics.counts);
  read_map(read, oracle(), statistics.oracle);
  read_map(read, funnels(), statistics.funnels);
  read_map(read, factors(), statistics.factors);
  read_map(read, versions(), statistics.versions);
  read_map(read, seen(), statistics.seen);
  read(extremes(), [&](Extreme&& row) { statistics.extremes[row.name] = std::move(row); });
  return statistics;
}

}  // namespace nearmiss
