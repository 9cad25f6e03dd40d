#include "tools/arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iostream>
#include <limits>
#include <set>
#include <thread>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "ccd/query/printable.hpp"
#include "ccd/subjects/plugin.hpp"
#include "corpus/query_text.hpp"
#include "corpus/readers.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/simulation/simulation_family.hpp"
#include "fuzz/subjects/subjects.hpp"

namespace nearmiss::tools {

void add_subject_option(CLI::App& command, std::vector<std::string>& names) {
  command
      .add_option(
          "--subject", names,
          "CCDs to put on trial, separated by commas: names (see nearmiss subjects) or paths of plug-ins "
          "(./plugin.so); NAME=./plugin.so gives a name. Versions of one CCD are compared query by query")
      ->delimiter(',')
      ->capture_default_str()
      ->type_name("A,B,...");
}

void add_verbose_option(CLI::App& command, bool& verbose) {
  command.add_flag("-v,--verbose", verbose, "Show all tables, and more findings");
}

void add_jobs_option(CLI::App& command, int& jobs) {
  jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  add_count_option(command, "--jobs", jobs, 1, 4096, "Number of threads");
}

void add_seed_option(CLI::App& command, std::uint64_t& seed) {
  add_count_option(command, "--seed", seed, 0, std::numeric_limits<std::uint64_t>::max(),
                   "Seed of the random queries; a query depends only on its family, seed and number");
}

void add_comparison_options(CLI::App& command, Comparison& comparison) {
  add_count_option(
      command, "--compare", comparison.one_in, 1, most_queries,
      fmt::format(
          "Compare the oracle's exact methods, and check certificates of its answers, on one query in N, "
          "and on {} times as large a part of the queries that its filter leaves undecided; 1 compares "
          "all. Families near overflow and underflow are always compared.",
          Comparison::more_of_undecided));
  command.add_flag(
      "--compare-near-bounds", comparison.near_bounds,
      fmt::format(
          "Also compare queries that the filter could not decide if its error bounds were multiplied by {}",
          Comparison::caution));
}

CLI::Option* SeparationOption::add_to(CLI::App& command, bool can_be_drawn) {
  return command
      .add_option(
          "--separation", text,
          fmt::format("Ask whether the primitives come within the distance H of each other, in the unit of "
                      "the coordinates{}; 0 asks for contact. Replaces the separations that queries have",
                      can_be_drawn ? "; drawn: each query draws its own" : ""))
      ->type_name(can_be_drawn ? "H|drawn" : "H");
}

std::string SeparationOption::of_families() const {
  const bool is_number = is_given() && text != drawn_separation;
  return is_number && parse_separation(text, "--separation") == 0 ? "" : text;
}

Query SeparationOption::apply(const Query& query) const {
  return is_given() ? with_separation(query, parse_separation(text, "--separation")) : query;
}

void expect_kind(const Subject& subject, Kind kind) {
  if (!subject.decides(kind))
    throw Error(fmt::format("{}: found queries of kind {}, which it does not decide", subject.name(),
                            short_name(kind)));
}

void expect_separation(const Subject& subject, std::span<const Kind> of) {
  if (std::ranges::none_of(of, [&](Kind kind) { return subject.decides(kind); }))
    expect_kind(subject, of.front());
  const auto takes = [&](Kind kind) { return subject.takes_separation(kind); };
  const bool takes_some = std::ranges::any_of(kinds, takes);
  if (std::ranges::none_of(of, takes))
    throw Error(fmt::format(
        "{}: answers for contact only{}, expected subjects that take a separation (nearmiss subjects)",
        subject.name(), takes_some ? fmt::format(" in queries of kind {}", short_name(of.front())) : ""));
}

void expect_separations(const Subjects& subjects, std::span<const Kind> of) {
  const auto decides_some = [&](const auto& subject) {
    return std::ranges::any_of(of, [&](Kind kind) { return subject->decides(kind); });
  };
  const bool is_in_vain = std::ranges::none_of(subjects, decides_some);
  for (const auto& subject : subjects)
    if (is_in_vain || decides_some(subject)) expect_separation(*subject, of);
}

void add_bound_option(CLI::App& command, std::string& bound) {
  command.add_option("--bound", bound, "Use this bound B for every pair, instead of the pair's own")
      ->type_name("B");
}

std::vector<std::string> short_names_of_kinds() {
  std::vector<std::string> names;
  for (const Kind each : kinds) names.emplace_back(short_name(each));
  return names;
}

void QueryInput::add_to(CLI::App& command) {
  command
      .add_option(
          "--kind", kind,
          "vt: vertex x0 against triangle x1 x2 x3; ee: edge x0x1 against edge x2x3; vv: vertices x0 and "
          "x1; ve: vertex x0 against edge x1x2")
      ->required()
      ->check(CLI::IsMember(short_names_of_kinds()));
  command
      .add_option(
          "FILE", file,
          "Queries, one a line: three numbers for each vertex, x0 x1 .. at t = 0, then at t = 1 (24, or 12 "
          "for vv and 18 for ve); one more is the separation; - is standard input")
      ->capture_default_str();
  separation.add_to(command);
}

void QueryInput::read(const std::function<void(const Query&)>& sink) const {
  const Kind of = parse_kind(kind, "--kind");
  const auto each = [&](const Case& read) { sink(separation.apply(read.query)); };
  if (file == "-") {
    std::ios::sync_with_stdio(false);  // otherwise, a read error would look like the end of input
    return read_query_lines(std::cin, of, "stdin", each);
  }
  std::ifstream in(file);
  if (!in) throw Error(fmt::format("{}: cannot be read", file));
  read_query_lines(in, of, file, each);
}

void PluginLimitOptions::add_to(CLI::App& command) {
  command
      .add_option("--query-time", time, "Time limit per query for a plug-in, which runs in its own process")
      ->capture_default_str()
      ->type_name("T");
  command
      .add_option_function<std::string>(
          "--query-memory", [this](const std::string& text) { bytes = parse_size(text, "--query-memory"); },
          "Memory limit for a plug-in, such as 512M or 1G; 0 means no limit")
      ->default_str("1G")
      ->type_name("BYTES");
}

isolation::PluginLimits PluginLimitOptions::limits() const {
  return {.time = parse_duration(time, "--query-time"), .bytes = bytes};
}

void expect_printable(const std::string& subject) {
  if (printable(subject) != subject)
    throw Error(
        fmt::format("--subject: found '{}', expected a path in UTF-8 without control characters or "
                    "others that are not seen, because reports name it",
                    excerpt(subject)));
}

Subjects make_subjects(const std::vector<std::string>& texts, const isolation::PluginLimits& limits,
                       std::optional<double> given_bound) {
  Subjects made;
  for (const std::string& text : texts) {
    expect_printable(text);
    for (auto& subject : make_any_subjects(text, given_bound, limits)) made.push_back(std::move(subject));
  }
  tell_apart(made);
  return made;
}

namespace {

/// The families that the word "all" or "vertices" stands for. Returns nothing if `name` is any other word.
std::optional<std::span<const Family>> group_of_families(std::string_view name, std::span<const Family> all) {
  if (name == "all") return all;
  if (name == "vertices") return vertex_families();
  return std::nullopt;
}

std::vector<Family> different(std::vector<Family> found, std::string_view option) {
  std::set<std::string> names;
  for (const Family& family : found)
    if (!names.insert(family.name).second)
      throw Error(
          fmt::format("found the family '{}' twice in {}, expected different ones", family.name, option));
  return found;
}

}  // namespace

std::vector<Family> find_families(const std::vector<std::string>& names, std::span<const Family> known,
                                  std::span<const Family> all, const Stop& stop) {
  std::vector<Family> found;
  for (const std::string& name : names)
    if (const auto group = group_of_families(name, all))
      found.insert(found.end(), group->begin(), group->end());
    else
      found.push_back(find_any_family(name, stop, known));
  return different(std::move(found), "--family");
}

std::vector<Family> find_sweeps(const std::vector<std::string>& names, int steps,
                                std::span<const Family> known, std::span<const Family> all) {
  std::vector<Family> found;
  const auto add = [&](const Family& family) {
    for (Family& step : sweep(family, steps)) found.push_back(std::move(step));
  };
  for (const std::string& name : names)
    if (const auto group = group_of_families(name, all))
      std::for_each(group->begin(), group->end(), [&](const Family& each) {
        if (each.parameter) add(each);
      });
    else
      add(find_family(name, known));
  return different(std::move(found), "--sweep");
}

std::pair<std::uint64_t, std::uint64_t> parse_shard(std::string_view text) {
  std::uint64_t shard = 0;
  std::uint64_t shards = 0;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, shard);
  const bool slash = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
  const auto second = std::from_chars(slash ? first.ptr + 1 : end, end, shards);
  constexpr std::uint64_t most = 1'000'000;
  if (!slash || second.ec != std::errc() || second.ptr != end || shard >= shards || shards > most)
    throw Error(fmt::format("--shard: found '{}', expected I/N with 0 <= I < N <= {}, such as 0/4",
                            excerpt(text), most));
  return {shard, shards};
}

std::optional<double> parse_bound(std::string_view text) {
  if (text.empty()) return std::nullopt;
  const double bound = parse_number(text, "--bound");
  if (!(bound > 0))
    throw Error(fmt::format("--bound: found '{}', expected a positive number", excerpt(text)));
  return bound;
}

}  // namespace nearmiss::tools
