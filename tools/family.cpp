// nearmiss family: prints the queries of a family as text.
#include "fuzz/families/families.hpp"

#include <fmt/format.h>

#include "corpus/query_text.hpp"
#include "tools/arguments.hpp"
#include "tools/commands.hpp"
#include "tools/values.hpp"

namespace nearmiss::tools {

namespace {

struct Options {
  std::string name, kind;
  std::uint64_t seed = 1;
  std::uint64_t first = 0;
  std::uint64_t count = 0;
};

/// Prints the queries of one kind among the indices first .. first + count - 1.
void run(const Options& options) {
  const Family family = find_family(options.name);
  const Kind kind = parse_kind(options.kind, "--kind");
  for (std::uint64_t i = 0; i < options.count; ++i) {
    const std::uint64_t index = options.first + i;
    if (kind_of(index) == kind) fmt::print("{}\n", to_line(make_query(family, options.seed, index)));
  }
}

}  // namespace

void add_family(CLI::App& app, int& /*exit_code*/) {
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand(
      "family",
      "Print queries of a family, one a line, in the format that nearmiss oracle and nearmiss verdict read");
  command
      ->add_option("NAME", options->name, "The family, NAME or NAME@VALUE; nearmiss fuzz --help lists them")
      ->required();
  command
      ->add_option("--kind", options->kind,
                   "Print the queries of this kind: even indices are vt, odd ones ee")
      ->required()
      ->check(CLI::IsMember({"vt", "ee"}));
  add_seed_option(*command, options->seed);
  add_count_option(*command, "--count", options->count, 1, most_queries,
                   "Number of indices; about half are of each kind")
      ->required()
      ->default_str("");
  add_count_option(*command, "--first", options->first, 0, most_queries,
                   "The first index; a campaign begins with 0");
  command->footer(
      "\nThe provenance NAME:S:I in a report is query I of family NAME with seed S.\n"
      "Example: nearmiss family uniform --kind vt --count 1000 | nearmiss oracle --kind vt");
  command->callback([options] { run(*options); });
}

}  // namespace nearmiss::tools
