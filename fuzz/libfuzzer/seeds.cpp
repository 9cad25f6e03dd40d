// Writes the inputs from which libFuzzer starts. `fuzz_seeds FOLDER CASES...` writes the inputs of each
// target into FOLDER/TARGET. The inputs are made from the cases in the files and folders CASES, and from some
// queries of each family.
#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ccd/query/error.hpp"
#include "corpus/query_text.hpp"
#include "corpus/readers.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/libfuzzer/query_bytes.hpp"
#include "reports/store/store.hpp"

namespace nearmiss::libfuzzer {
namespace {

namespace fs = std::filesystem;

/// Some queries of each family.
std::vector<Case> cases_of(std::span<const Family> families) {
  constexpr std::uint64_t of_each_family = 10;
  std::vector<Case> cases;
  for (const Family& each_family : families) {
    const Family family = as_asked(each_family);
    for (std::uint64_t i = 0; i < of_each_family; ++i) {
      Case each;
      each.query = make_query(family, 1, i);
      each.name = fmt::format("{}-{}", family.name, i);
      cases.push_back(std::move(each));
    }
  }
  return cases;
}

/// The cases in the folders, and some queries of families() and vertex_families().
std::vector<Case> make_cases(const std::vector<fs::path>& folders) {
  std::vector<Case> cases = cases_of(families());
  for (Case& each : cases_of(vertex_families())) cases.push_back(std::move(each));
  for (const fs::path& folder : folders)
    read_cases(folder, [&](Case&& each) {
      std::replace(each.name.begin(), each.name.end(), '/', '-');
      cases.push_back(std::move(each));
    });
  return cases;
}

std::string bytes(const Query& query) {
  std::array<std::uint8_t, query_bytes> data{};
  const std::size_t size = to_bytes(query, data.data());
  return {data.begin(), data.begin() + size};
}

std::string sample_csv(const Case& each) {
  std::string text;
  for (std::size_t i = 0; i < 24; ++i) {
    const mpq_class c(each.query.x[i]);
    text += fmt::format("{},{},", c.get_num().get_str(), c.get_den().get_str());
    if (i % 3 == 2) text += fmt::format("{}\n", each.truth.value_or(false) ? 1 : 0);
  }
  return text;
}

std::string obj(const Query& query) {
  std::string text = "# eight points\no primitive\n";
  for (std::size_t i = 0; i < 8; ++i)
    text += fmt::format("v {} {} {}\n", query.x[3 * i], query.x[3 * i + 1], query.x[3 * i + 2]);
  return text + "vn 0 0 1\nvt 0 0\nf 1 2 3\nf 5/1 6/1 7/1 8/1\nf -8//1 -7//1 -6//1\nf 1/1/1 2/1/1 5/1/1\n";
}

/// A PLY file with two triangles. `numbers` is everything after the header, as text or as bytes.
std::string ply(const std::string& encoding, const std::string& numbers) {
  return "ply\nformat " + encoding +
         " 1.0\nelement vertex 8\nproperty double x\nproperty double y\nproperty double z\nelement face 2\n"
         "property list uchar int vertex_indices\nend_header\n" +
         numbers;
}

template <class Number>
void append(std::string& bytes, Number value, bool little_endian = true) {
  std::array<char, sizeof value> raw{};
  std::memcpy(raw.data(), &value, sizeof value);
  if (!little_endian) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

std::string binary_ply(const Query& query, bool little_endian) {
  std::string numbers;
  for (const double c : query.x) append(numbers, c, little_endian);
  for (const std::int32_t first : {0, 4}) {
    append(numbers, std::uint8_t{3});
    for (std::int32_t i = 0; i < 3; ++i) append(numbers, first + i, little_endian);
  }
  return ply(little_endian ? "binary_little_endian" : "binary_big_endian", numbers);
}

std::string binary_stl(const Query& query) {
  std::string bytes(80, ' ');
  append(bytes, std::uint32_t{1});
  for (int i = 0; i < 3; ++i) append(bytes, 0.0F);
  for (std::size_t i = 0; i < 9; ++i)
    append(bytes, std::clamp(static_cast<float>(query.x[i]), -1e30F, 1e30F));
  append(bytes, std::uint16_t{0});
  return bytes;
}

std::vector<std::string> meshes(const Query& query) {
  const auto points = [&](std::string_view before, std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i)
      text += fmt::format("{}{} {} {}\n", before, query.x[3 * i], query.x[3 * i + 1], query.x[3 * i + 2]);
    return text;
  };
  return {
      "OFF\n8 2 0\n" + points("", 8) + "3 0 1 2\n4 4 5 6 7\n",
      ply("ascii", points("", 8) + "3 0 1 2\n3 4 5 6\n"),
      binary_ply(query, true),
      binary_ply(query, false),
      "solid a\nfacet normal 0 0 1\nouter loop\n" + points("vertex ", 3) + "endloop\nendfacet\nendsolid a\n",
      binary_stl(query)};
}

/// A campaign with results of every sort.
Campaign campaign() {
  const Query query = make_query(families().front(), 1, 0);
  Campaign campaign;
  Statistics& statistics = campaign.statistics;
  const auto provenance = [] { return "uniform:1:0"; };
  for (const char* subject : {"wang", "additive:rescaling=0.5", "additive:rescaling=0.9"})
    for (const char* family : {"uniform", "search-miss@wang", "crossed~0.1", "scene:cloth#3", "folder/"}) {
      Counts& counts = statistics.counts[{subject, query.kind, family}];
      counts.add({.verdict = {true, Stage::ve_minimum, 0.5},
                  .collision = true,
                  .time = TimeError{.early = 0.25, .travelled = 0.5, .promised = true}},
                 query, provenance);
      counts.add({.verdict = {false, Stage::none, 0}, .collision = true}, query, provenance);
      counts.add({.verdict = {true, Stage::vv, 0.5}, .ratio = 0.5}, query, provenance);
      counts.times.add(query.kind, family, {3, 300});
      counts.times.add(100, query, provenance);
      statistics.oracle[{query.kind, family}].queries = 3;
    }
  statistics.funnels[{"scene:cloth#3", query.kind}] = {{1, 2, 3, 4, 5}, 6, 7, 8};
  statistics.simulated[{"scene:sim:cloths", "wang", 3}] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  count_answer(statistics.factors, {"wang", query.kind, "crossed", ""},
               std::array<std::string, 2>{"scale=1", "when=at-1"}, true, false);
  statistics.versions[{"old", "wang", query.kind, "uniform"}] = {1, 2, 3, 4};
  statistics.extremes["mu"] = {Extreme::Of::accepting_tolerance, "mu", 0.5, query, "uniform:1:0", 7};
  Run run{{{"command", "fuzz"}, {"seed", "1"}}, {{.count = 2, .environment = {{"cpu", "some"}}}}, {}};
  for (const auto what : {Finding::What::false_negative, Finding::What::late, Finding::What::fault}) {
    run.findings.push_back({.what = what,
                            .subject = "wang",
                            .family = "uniform",
                            .query = query,
                            .provenance = "uniform:1:0",
                            .signature = "vt simple-root inside in-face",
                            .shrunk = query,
                            .simplest = query});
    statistics.seen[signature_of(run.findings.back())] = 5;
  }
  run.pictures.push_back({"scene:cloth#3", R"({"points":[0,1]})"});
  campaign.runs.push_back(run);
  return campaign;
}

/// The SQL statements, one per line, that make the store of a campaign. Each checksum is replaced with 0. To
/// get the statements, this function writes the store to `file`, and removes the file at the end.
std::string statements_of(const Campaign& campaign, const fs::path& file) {
  fs::remove(file);
  write_campaign(campaign, file);
  SQLite::Database db(file.string());
  std::string text;
  for (const char* number : {"application_id", "user_version"})
    text +=
        fmt::format("PRAGMA {} = {}\n", number, db.execAndGet(fmt::format("PRAGMA {}", number)).getString());
  SQLite::Statement tables(db, "SELECT name, sql FROM sqlite_schema WHERE sql IS NOT NULL ORDER BY rowid");
  while (tables.executeStep()) {
    const std::string table = tables.getColumn(0).getString();
    text += tables.getColumn(1).getString() + "\n";
    SQLite::Statement rows(db, fmt::format("SELECT quote(key), quote(value) FROM {}", table));
    while (rows.executeStep() && table != "contents")
      text += fmt::format("INSERT INTO {} VALUES ({}, {}, 0)\n", table, rows.getColumn(0).getString(),
                          rows.getColumn(1).getString());
  }
  fs::remove(file);
  return text;
}

/// Campaigns for the seeds: one with all results, and some that lack a part of their results.
std::map<std::string, Campaign> campaigns() {
  const Campaign whole = campaign();
  return {{"whole", whole},
          {"findings", {.runs = whole.runs, .statistics = {}}},
          {"statistics", {.runs = {{{{"command", "fuzz"}}, {{}}, {}}}, .statistics = whole.statistics}},
          {"begun", {.runs = {{{{"command", "fuzz"}}, {{}}, {}}}, .statistics = {}}}};
}

void write_seeds(const fs::path& folder, const std::vector<fs::path>& cases) {
  const auto write = [&](const char* target, const std::string& name, const std::string& text) {
    fs::create_directories(folder / target);
    std::ofstream(folder / target / name, std::ios::binary) << text;
  };
  fs::create_directories(folder);
  for (const auto& [name, each] : campaigns())
    write("read_store", name + ".sql", statements_of(each, folder / "store.db"));
  for (const Case& each : cases_of(separation_families()))
    for (const char* target : {"false_negative", "late"}) write(target, each.name, bytes(each.query));
  // Mesh files are made from only one case in this many. A few mesh files are enough, since they differ
  // little from each other.
  constexpr std::size_t one_in_with_meshes = 10;
  for (std::size_t number = 0; const Case& each : make_cases(cases)) {
    for (const char* target : {"false_negative", "late", "refuted_bound", "oracle_disagreement"})
      write(target, each.name, bytes(each.query));
    write("read_case", each.name, to_text(each));
    write("read_csv", each.name, sample_csv(each));
    write("read_queries", each.name, fmt::format("# {}\n{}\n", each.name, to_line(each.query)));
    if (number++ % one_in_with_meshes != 0) continue;
    write("read_obj", each.name, obj(each.query));
    for (std::size_t i = 0; const std::string& mesh : meshes(each.query))
      write("read_mesh", fmt::format("{}-{}", each.name, i++), mesh);
  }
}

}  // namespace
}  // namespace nearmiss::libfuzzer

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: fuzz_seeds FOLDER CASES...\n");
    return 2;
  }
  try {
    nearmiss::libfuzzer::write_seeds(argv[1], {argv + 2, argv + argc});
  } catch (const nearmiss::Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
  return 0;
}
