// nearmiss family: prints the queries of a family as text.
#include "fuzz/families/families.hpp"

#include <fmt/format.h>

#include <map>

#include "ccd/query/error.hpp"
#include "corpus/query_text.hpp"
#include "fuzz/families/classify.hpp"
#include "fuzz/families/crossed.hpp"
#include "fuzz/simulation/simulation_family.hpp"
#include "fuzz/subjects/contracted.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "oracle/oracle.hpp"
#include "reports/sections/sections.hpp"
#include "reports/text/text.hpp"
#include "tools/arguments.hpp"
#include "tools/commands.hpp"

namespace nearmiss::tools {

namespace {

struct FamilyOptions {
  std::string name, kind;
  std::uint64_t seed = 1;
  std::uint64_t first = 0;
  std::uint64_t count = 0;
  bool factors = false, coverage = false, classes = false;
  std::string only_class, subject;
  PluginLimitOptions limits;
};

/// Prints a line for each of `count` queries of one kind, starting with the index `first`. A line has the
/// query or, with --factors, the values of the properties that the family varies. With --class, leaves out
/// queries of other classes.
void print_queries(const FamilyOptions& options, const Family& family) {
  const Kind kind = parse_kind(options.kind, "--kind");
  expect_kind(family, kind, "--kind");
  std::uint64_t printed = 0;
  for (std::uint64_t index = options.first; printed < options.count; ++index) {
    if (kind_of(family, index) != kind) continue;
    ++printed;
    const Query query = make_query(family, options.seed, index);
    if (!options.only_class.empty() && name(classify(query)) != options.only_class) continue;
    fmt::print("{}\n", options.factors
                           ? fmt::format("{}", fmt::join(factors_of(family, options.seed, index), " "))
                           : to_line(query));
  }
}

/// For each kind, divides the queries into groups: the ordinary queries and, for each rule of
/// why_not_ordinary(), the queries that are not ordinary because of this rule. Prints the numbers of queries
/// and of collisions in each group.
void print_classes(const FamilyOptions& options, const Family& family) {
  struct Count {
    std::uint64_t queries = 0, collisions = 0;
  };
  std::map<Kind, Count> sums;
  std::map<std::pair<Kind, std::string>, Count> counts;
  for (std::uint64_t index = options.first; index < options.first + options.count; ++index) {
    const Query query = make_query(family, options.seed, index);
    const std::string_view reason = why_not_ordinary(query);
    const bool collision = collides(query);
    for (Count* each :
         {&sums[query.kind], &counts[{query.kind, reason.empty() ? "ordinary" : std::string(reason)}]}) {
      ++each->queries;
      each->collisions += collision ? 1 : 0;
    }
  }
  std::vector<std::vector<std::string>> rows{{"kind", "class or rule", "queries", "", "collisions", ""}};
  for (const auto& [of, count] : counts) {
    const Count& sum = sums[of.first];
    rows.push_back({std::string(short_name(of.first)), of.second, with_separators(count.queries),
                    percent(count.queries, sum.queries), with_separators(count.collisions),
                    percent(count.collisions, sum.collisions)});
  }
  fmt::print("{}", columns(rows, 2));
}

void print_combinations(std::string_view name, const crossed::Combinations& combinations,
                        std::uint64_t queries) {
  fmt::print("{}: {} of the {} that are made occur in {}\n", name, with_separators(combinations.seen),
             with_separators(combinations.made), counted(queries, "query", "queries"));
  for (const std::string& missing : combinations.missing) fmt::print("never: {}\n", missing);
}

void print_coverage(const FamilyOptions& options) {
  const crossed::Coverage found = crossed::coverage(options.seed, options.first, options.count);
  for (const std::string& pair : found.pairs_not_made) fmt::print("not made: {}\n", pair);
  print_combinations("pairs", found.pairs, options.count);
  print_combinations("triples", found.triples, options.count);
}

/// Asks a subject about the queries, and prints for each kind which properties the missed collisions have in
/// common. Leaves out queries without an answer.
void print_common_factors(const FamilyOptions& options, const Family& family) {
  const auto asked =
      keep_contract(make_any_subject(options.subject, std::nullopt, options.limits.limits()), false);
  const Subject& subject = *asked.front();
  FactorTable table;
  for (std::uint64_t index = options.first; index < options.first + options.count; ++index) {
    const Query query = make_query(family, options.seed, index);
    const Verdict verdict = subject.decide(query);
    if (verdict.fault == Fault::none)
      count_answer(table, {subject.name(), query.kind, family.name, ""},
                   factors_of(family, options.seed, index), collides(subject.rounded(query)), verdict.hit);
  }
  const std::vector<CommonFactors> common = common_factors(table);
  for (const auto& [key, each] : table) {
    if (!key.values.empty()) continue;
    fmt::print("{} {}: {} of {} missed", key.subject, short_name(key.kind),
               with_separators(each.false_negatives), counted(each.collisions, "collision", "collisions"));
    for (const CommonFactors& of_kind : common)
      if (of_kind.key.kind == key.kind) fmt::print("; {}", to_text(of_kind));
    fmt::print("\n");
  }
}

void run(const FamilyOptions& options) {
  const Family family = find_any_family(options.name);
  const bool is_plain = !options.factors && !options.coverage && options.subject.empty();
  if (options.classes) return print_classes(options, family);
  if (options.coverage && family.name != "crossed")
    throw Error(fmt::format("found the family '{}', expected crossed with --coverage", family.name));
  if (!is_plain && !family.factors)
    throw Error(fmt::format("found the family '{}', expected one with factors, such as crossed, with {}",
                            family.name, options.factors ? "--factors" : "--missed-by"));
  if (is_plain && options.kind.empty()) throw CLI::RequiredError("--kind");
  if (options.coverage)
    print_coverage(options);
  else if (!options.subject.empty())
    print_common_factors(options, family);
  else
    print_queries(options, family);
}

}  // namespace

void add_family(CLI::App& app, int& /*exit_code*/) {
  auto options = std::make_shared<FamilyOptions>();
  auto* command = app.add_subcommand(
      "family",
      "Print queries of a family, one a line, in the format that nearmiss oracle and nearmiss verdict read");
  command
      ->add_option("NAME", options->name,
                   "The family, NAME, NAME@VALUE or sim:SCENE; nearmiss fuzz --help lists them")
      ->required();
  auto* kind =
      command
          ->add_option("--kind", options->kind,
                       "Print the queries of this kind: even indices are vt (or vv), odd ones ee (or ve)")
          ->check(CLI::IsMember(short_names_of_kinds()));
  auto* coverage = command
                       ->add_flag("--coverage", options->coverage,
                                  "Print which pairs and triples of factors occur in the queries of both "
                                  "kinds; crossed only")
                       ->excludes(kind);
  auto* classes =
      command
          ->add_flag(
              "--classes", options->classes,
              "Print how many of the queries of each kind, and of their collisions, are ordinary, extreme, "
              "or degenerate by which rule (the first that holds)")
          ->excludes(kind)
          ->excludes(coverage);
  command
      ->add_option("--missed-by", options->subject,
                   "Print which factors the collisions have in common that this subject misses, in a family "
                   "with factors")
      ->excludes(kind)
      ->excludes(coverage)
      ->excludes(classes);
  options->limits.add_to(*command);
  command
      ->add_flag("--factors", options->factors,
                 "Print each query's factors instead of the query, in a family with factors")
      ->needs(kind);
  command
      ->add_option("--class", options->only_class,
                   "Of the --count queries, print only those of this class (fuzz/families/README.md)")
      ->check(CLI::IsMember({"ordinary", "degenerate", "extreme"}))
      ->needs(kind);
  add_seed_option(*command, options->seed);
  add_count_option(
      *command, "--count", options->count, 1, most_queries,
      "Number of queries, of --kind or, with --coverage, --classes and --missed-by, of both kinds")
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
