// nearmiss oracle: the truth about queries.
#include <fmt/format.h>

#include "corpus/query_text.hpp"
#include "oracle/oracle.hpp"
#include "tools/arguments.hpp"
#include "tools/commands.hpp"

namespace nearmiss::tools {

namespace {

struct Options {
  std::string kind, method = "exact", file = "-";
  bool toi = false;
  bool distance = false;
};

std::string show(const Enclosure& enclosure) {
  return fmt::format(" {} {}", to_hex(enclosure.lo), to_hex(enclosure.hi));
}

std::string answer(const Query& query, const Options& options) {
  std::string line = collides(query) ? "1" : "0";
  if (options.toi) {
    const auto time = earliest_time(query);
    line += time ? show(*time) : " inf inf";
  }
  if (options.distance) line += show(minimum_distance(query));
  return line;
}

}  // namespace

void add_oracle(CLI::App& app, int& /*exit_code*/) {
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand(
      "oracle", "Decide queries in exact arithmetic: a line each, 1 for a collision, 0 for none");
  add_kind_option(*command, options->kind);
  command->add_option("--method", options->method, "exact: real roots as algebraic numbers, complete")
      ->check(CLI::IsMember({"exact"}))
      ->capture_default_str();
  command->add_flag("--toi", options->toi,
                    "Add 'lo hi' around the earliest time of contact (inf inf where there is none)");
  command->add_flag("--distance", options->distance, "Add 'lo hi' around the smallest distance over [0, 1]");
  command
      ->add_option("FILE", options->file, "One query a line: 24 numbers, x0 x1 x2 x3 at t = 0, then at t = 1")
      ->capture_default_str();
  command->footer(
      "\nNumbers are decimal or C hex floats, separated by blanks or commas; '#' starts a comment.\n"
      "Example: echo '0 0 1 0 0 0 1 0 0 0 1 0  0 0 -1 0 0 0 1 0 0 0 1 0' | "
      "nearmiss oracle --kind vt --toi");
  command->callback([options] {
    read_queries(options->file, parse_kind(options->kind, "--kind"),
                 [&](const Query& query) { fmt::print("{}\n", answer(query, *options)); });
  });
}

}  // namespace nearmiss::tools
