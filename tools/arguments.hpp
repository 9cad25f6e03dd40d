// Options that several subcommands share, and the parsing of their values.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ccd/query/query.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/subjects/isolation/isolated_plugin.hpp"
#include "fuzz/trial/trial.hpp"
#include "reports/text/values.hpp"

namespace nearmiss::tools {

/// The largest number of queries that an option takes.
inline constexpr std::uint64_t most_queries = std::uint64_t{1} << 62;

/// Adds an option whose value is a whole number from `least` to `most`. --help shows the value that `value`
/// has at this call as the default. `value` must live as long as the command.
template <class Integer>
CLI::Option* add_count_option(CLI::App& command, const std::string& name, Integer& value, std::uint64_t least,
                              std::uint64_t most, const std::string& description) {
  return command
      .add_option_function<std::string>(
          name,
          [&value, name, least, most](const std::string& text) {
            value = static_cast<Integer>(parse_count(text, name, least, most));
          },
          description)
      ->default_str(std::to_string(value))
      ->type_name("N");
}

/// --subject A,B,./plugin.so: the subjects on trial.
void add_subject_option(CLI::App& command, std::vector<std::string>& names);

/// --jobs J: the number of threads; by default, one for each core.
void add_jobs_option(CLI::App& command, int& jobs);
void add_verbose_option(CLI::App& command, bool& verbose);

/// --seed S: the seed of the random queries.
void add_seed_option(CLI::App& command, std::uint64_t& seed);

/// --compare N and --compare-near-bounds: the queries on which all exact methods of the oracle are compared.
void add_comparison_options(CLI::App& command, Comparison& comparison);

/// --separation H: the separation of every query.
struct SeparationOption {
  std::string text;

  /// Adds the option. If `can_be_drawn` is true, the option also takes the value "drawn", with which each
  /// query has a random separation.
  CLI::Option* add_to(CLI::App& command, bool can_be_drawn = false);
  [[nodiscard]] bool is_given() const { return !text.empty(); }
  /// The separation of queries in families that have no separations of their own: "drawn", a positive number
  /// or, for contact, "". Throws Error if the option's value is neither "drawn" nor a separation.
  [[nodiscard]] std::string of_families() const;
  /// The query, with the option's separation if the option is given. Throws Error if the value is not a
  /// separation.
  [[nodiscard]] Query apply(const Query& query) const;
};

/// "vt", "ee" and so on: the values of --kind.
std::vector<std::string> short_names_of_kinds();

/// Throws Error if the subject does not decide queries of this kind.
void expect_kind(const Subject& subject, Kind kind);

/// Throws Error if the subject takes separations for none of these kinds.
void expect_separation(const Subject& subject, std::span<const Kind> of = kinds_of_meshes);
/// Throws Error if no subject decides any of these kinds. Also throws Error if a subject decides some of
/// these kinds, but takes separations for none of them.
void expect_separations(const Subjects& subjects, std::span<const Kind> of = kinds_of_meshes);

/// --bound B: one bound B for all pairs, in place of the bound of each pair.
void add_bound_option(CLI::App& command, std::string& bound);

/// --query-time T and --query-memory BYTES: the limits of a plug-in.
struct PluginLimitOptions {
  std::string time = "1s";
  std::uint64_t bytes = isolation::PluginLimits().bytes;

  void add_to(CLI::App& command);
  /// Throws Error if a value is not a time or a number of bytes.
  [[nodiscard]] isolation::PluginLimits limits() const;
};

/// --kind KIND and FILE: the kind of the queries, and a file (- for standard input) with one query a line.
struct QueryInput {
  std::string kind, file = "-";
  SeparationOption separation;

  void add_to(CLI::App& command);
  /// Passes every query to `sink`, in order. Throws Error if the file cannot be read, or has a line that is
  /// not a query.
  void read(const std::function<void(const Query&)>& sink) const;
};

/// Throws Error if printable() would change a subject's text.
void expect_printable(const std::string& subject);

/// Makes the subjects that `texts` denote (fuzz/subjects/subjects.hpp), and gives them distinct names. Each
/// plug-in runs in a process of its own. Throws Error for an unknown subject, and for a text that
/// expect_printable() refuses.
Subjects make_subjects(const std::vector<std::string>& texts, const isolation::PluginLimits& limits = {},
                       std::optional<double> given_bound = std::nullopt);

/// Finds the families with these names: NAME, NAME@VALUE and so on (find_any_family). "all" stands for the
/// families in `all`, and "vertices" for the families of vv and ve queries. Throws Error for an unknown or
/// repeated name, and Stopped if the user ends the command.
std::vector<Family> find_families(const std::vector<std::string>& names, std::span<const Family> known,
                                  std::span<const Family> all, const Stop& stop);

/// Makes a sweep of each family NAME: families NAME@VALUE for `steps` values of NAME's parameter. "all"
/// stands for the families in `all` that have a parameter, and "vertices" for the families of vv and ve
/// queries that have a parameter. Throws Error for the name of a family without a parameter.
std::vector<Family> find_sweeps(const std::vector<std::string>& names, int steps,
                                std::span<const Family> known, std::span<const Family> all);

/// Parses a shard, "0/4" to "3/4" for four shards, into its index and the number of shards. Throws Error for
/// any other form.
std::pair<std::uint64_t, std::uint64_t> parse_shard(std::string_view text);

/// Parses a positive finite number; "" gives nothing. Throws Error for any other text.
std::optional<double> parse_bound(std::string_view text);

}  // namespace nearmiss::tools
