// nearmiss demo: shows in a moment what the tool does.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "ccd/query/error.hpp"
#include "corpus/file.hpp"
#include "corpus/query_text.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "fuzz/trial/judge.hpp"
#include "fuzz/trial/shrunk_finding.hpp"
#include "oracle/earliest_time.hpp"
#include "oracle/explanation.hpp"
#include "oracle/oracle.hpp"
#include "reports/campaign/finding_case.hpp"
#include "reports/text/shell.hpp"
#include "reports/text/text.hpp"
#include "tools/commands.hpp"
#include "tools/terminal_picture.hpp"

namespace nearmiss::tools {

namespace {

struct Options {
  std::filesystem::path out = "nearmiss-demo.case";
};

/// Whether a query is easy to draw: small coordinates, and not always in one plane.
bool is_plain(const Query& query) {
  return explain(query).roots > 0 &&
         std::all_of(query.x.begin(), query.x.end(), [](double c) { return std::abs(c) <= 10; });
}

/// Asks a subject random queries until it misses a collision that shrinks to a query that is easy to draw.
struct PlainMiss {
  std::uint64_t queries = 0, misses = 0;
  Finding finding;  ///< with the shrunk query

  explicit PlainMiss(const Subject& subject) {
    const Judge judge(subject);
    for (std::uint64_t index = 0;; ++index)
      for (const Family& family : mesh_families()) {
        ++queries;
        const Query query = make_query(family, 1, index);
        const auto failure = judge.failure(query);
        if (!failure || failure->what != Finding::What::false_negative) continue;
        ++misses;
        finding = {.what = failure->what,
                   .subject = subject.name(),
                   .family = std::string(family.name),
                   .query = query,
                   .provenance = fmt::format("{}:1:{}", family.name, index),
                   .signature = failure->signature};
        finding.shrunk = shrunk_query(finding, &subject);
        if (is_plain(finding.shrunk)) return;
      }
  }
};

void run(const Options& options) {
  if (options.out.extension() != ".case")
    throw Error(
        fmt::format("--output: found '{}', expected a name that ends in .case", options.out.string()));
  const auto basic = make_subject("basic");
  fmt::print(
      "basic is a textbook CCD: it solves a cubic for the times at which the four vertices are coplanar, in "
      "double\n"
      "arithmetic, and tests whether the primitives meet there. An exact oracle decides the same random "
      "queries.\n\n");
  const PlainMiss miss(*basic);
  const Finding& finding = miss.finding;
  replace_file(options.out, to_text(to_case(of_shrunk(finding))));
  fmt::print("After {}, basic has missed {}. The last of these is from the family {}:\n{}\n",
             counted(miss.queries, "query", "queries"), counted(miss.misses, "collision", "collisions"),
             finding.family, vertex_lines(finding.query));
  const double time = earliest_time(finding.shrunk)->enclosure().lo;
  fmt::print(
      "The simplest query that basic misses in the same way ({}):\n{}\n{}\nAt t = {:.4g}, {} meet. In the "
      "picture, the first "
      "primitive is drawn with o, the second with #,\nvertices with their numbers, and their paths with "
      "dots.\n\n",
      to_text(explain(finding.shrunk)), vertex_lines(finding.shrunk), terminal_picture(finding.shrunk, time),
      time, has_triangle(finding.shrunk.kind) ? "the vertex and the triangle" : "the edges");
  const bool wang_hits = make_subject("wang")->decide(finding.shrunk).hit;
  fmt::print("wang, the failure-proof CCD, {} it.\n\n", wang_hits ? "reports" : "misses");
  fmt::print(
      "Replay it:              nearmiss replay {0} --subject basic,wang\n"
      "Make a test from it:    nearmiss shrink {0} --subject basic --as c++\n"
      "Try your own CCD:       nearmiss fuzz --subject ./yours.so --cases 100000   (README.md, \"Your own "
      "CCD\")\n",
      shell_quoted(options.out.string()));
}

}  // namespace

void add_demo(CLI::App& app, int& /*exit_code*/) {
  auto options = std::make_shared<Options>();
  auto* command =
      app.add_subcommand("demo", "Show what this tool does: a collision that a CCD misses, shrunk and drawn");
  command->add_option("-o,--output", options->out, "Write the miss to this file")
      ->type_name("FILE")
      ->capture_default_str();
  command->footer("\nTakes a second or two. The next command is printed at the end.");
  command->callback([options] { run(*options); });
}

}  // namespace nearmiss::tools
