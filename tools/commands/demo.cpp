// nearmiss demo: shows within a second what nearmiss does.
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
#include "fuzz/families/classify.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "fuzz/trial/judge.hpp"
#include "fuzz/trial/shrunk_finding.hpp"
#include "oracle/earliest_time.hpp"
#include "oracle/explanation.hpp"
#include "oracle/oracle.hpp"
#include "reports/campaign/finding_case.hpp"
#include "reports/statistics/family.hpp"
#include "reports/text/shell.hpp"
#include "reports/text/text.hpp"
#include "tools/commands.hpp"
#include "tools/terminal_picture.hpp"

namespace nearmiss::tools {

namespace {

struct DemoOptions {
  std::filesystem::path out = "nearmiss-demo.case";
};

/// Whether a query is easy to draw: its coordinates are small, and its vertices are coplanar at some times,
/// but not at all times.
bool is_plain(const Query& query) {
  return explain(query).roots > 0 &&
         std::all_of(query.x.begin(), query.x.end(), [](double c) { return std::abs(c) <= 10; });
}

/// Asks a subject random queries until the subject misses a collision whose shrunk query is easy to draw. If
/// `in_ordinary_families` is true, the queries are from ordinary families, and the missed query must be
/// ordinary, too. Otherwise, the queries are from all other families.
struct PlainMiss {
  std::uint64_t queries = 0, misses = 0;
  Finding finding;  ///< with the shrunk query

  PlainMiss(const Subject& subject, bool in_ordinary_families) {
    const Subject* const asked = &subject;
    const FindingShrinker shrinker({&asked, 1}, Stop::never(), {});
    const Judge judge(subject);
    for (std::uint64_t index = 0;; ++index)
      for (const Family& family : mesh_families()) {
        if ((class_of(family.name) == QueryClass::ordinary) != in_ordinary_families) continue;
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
                   .signature = failure->signature,
                   .query_class = classify(query)};
        if (in_ordinary_families && finding.query_class != QueryClass::ordinary) continue;
        shrinker.shrink(finding);
        if (is_plain(finding.shrunk)) return;
      }
  }
};

void say(const std::string& paragraph) { fmt::print("{}", wrapped(paragraph, "", 10, 100)); }

/// Prints a miss in ordinary families, the simplest query that the CCD misses in the same way, and a picture
/// of this query.
void show_ordinary_miss(const Finding& finding, const PlainMiss& miss) {
  say(fmt::format(
      "{} is a textbook CCD: it solves a cubic for the times at which the four vertices are coplanar, in "
      "double arithmetic, and tests whether the primitives meet there, without a tolerance. An exact oracle "
      "decides the same random queries.",
      finding.subject));
  fmt::print("\n");
  say(fmt::format("After {} of ordinary families, it has missed {}. The last of these is from the family {}:",
                  counted(miss.queries, "query", "queries"), counted(miss.misses, "collision", "collisions"),
                  finding.family));
  fmt::print("{}\n", vertex_lines(finding.query));
  say(fmt::format("The simplest ordinary query that it misses in the same way ({}):",
                  to_text(explain(finding.shrunk))));
  const double time = earliest_time(finding.shrunk)->enclosure().lo;
  fmt::print("{}\n{}\n", vertex_lines(finding.shrunk), terminal_picture(finding.shrunk, time));
  say(fmt::format(
      "At t = {:.4g}, {} meet. In the picture, the first primitive is drawn with o, the second with #, "
      "vertices with their numbers, and their paths with dots.",
      time, has_triangle(finding.shrunk.kind) ? "the vertex and the triangle" : "the edges"));
  fmt::print("\n");
}

/// Prints the answers of wang and basic to an ordinary query. Then prints, in simplified form, a collision
/// that basic misses in a family that is not ordinary.
void show_exotic_miss(const Query& ordinary) {
  const auto answer = [&](const Subject& subject) {
    return subject.decide(ordinary).hit ? "reports" : "misses";
  };
  const auto basic = make_subject("basic");
  const PlainMiss miss(*basic, false);
  const Finding& finding = miss.finding;
  say(fmt::format("wang, the failure-proof CCD, {} it. basic, a more careful textbook CCD, {} it, too.",
                  answer(*make_subject("wang")), answer(*basic)));
  say(fmt::format("After {} of degenerate and extreme families, basic has missed {}.",
                  counted(miss.queries, "query", "queries"),
                  counted(miss.misses, "collision", "collisions")));
  say(fmt::format("The last of these, simplified, is {} ({}):", name(finding.query_class),
                  to_text(explain(finding.shrunk))));
  fmt::print("{}\n", vertex_lines(finding.shrunk));
}

void run(const DemoOptions& options) {
  if (options.out.extension() != ".case")
    throw Error(
        fmt::format("--output: found '{}', expected a name that ends in .case", options.out.string()));
  const auto careless = make_subject("bridson:thickness=0");
  const PlainMiss miss(*careless, true);
  const Finding& finding = miss.finding;
  replace_file(options.out, to_text(to_case(of_shrunk(finding))));
  show_ordinary_miss(finding, miss);
  show_exotic_miss(finding.shrunk);
  fmt::print(
      "Replay the first:       nearmiss replay {0} --subject {1},wang\n"
      "Make a test from it:    nearmiss shrink {0} --subject {1} --as c++\n"
      "Try your own CCD:       nearmiss fuzz --subject ./yours.so --cases 100000   (see README.md)\n",
      shell_quoted(options.out.string()), careless->name());
}

}  // namespace

void add_demo(CLI::App& app, int& /*exit_code*/) {
  auto options = std::make_shared<DemoOptions>();
  auto* command =
      app.add_subcommand("demo", "Show what this tool does: a collision that a CCD misses, shrunk and drawn");
  command->add_option("-o,--output", options->out, "Write the miss to this file")
      ->type_name("FILE")
      ->capture_default_str();
  command->footer("\nTakes a second or two. The next command is printed at the end.");
  command->callback([options] { run(*options); });
}

}  // namespace nearmiss::tools
