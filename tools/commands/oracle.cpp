// nearmiss oracle: exact answers to queries.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <vector>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "corpus/query_text.hpp"
#include "oracle/agreement/answers.hpp"
#include "oracle/agreement/checked.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"
#include "tools/arguments.hpp"
#include "tools/commands.hpp"

namespace nearmiss::tools {

namespace {

// Values that --method takes in addition to the names of methods.
constexpr const char* filtered = "filtered";
constexpr const char* all = "all";

struct Options {
  QueryInput input;
  std::string method = filtered;
  bool toi = false;
  bool rational = false;
  double width = 0;
  bool distance = false;
};

/// Thrown if methods of the oracle disagree about a query, which is a defect of the oracle.
class Disagreement : public std::exception {
 public:
  explicit Disagreement(const Query& query)
      : what_(fmt::format("the oracle's answers disagree on {} {}", short_name(query.kind), to_line(query))) {
  }
  [[nodiscard]] const char* what() const noexcept override { return what_.c_str(); }

 private:
  std::string what_;
};

std::string show(const Enclosure& enclosure) {
  return fmt::format(" {} {}", to_hex(enclosure.lo), to_hex(enclosure.hi));
}

/// "1" for yes, "0" for no. As in the library, a smallest distance of exactly h > 0 is a yes. "-" if a
/// complete method cannot tell, or if any other method, such as root parity, gives no answer for such
/// queries.
const char* show(const Answer& answer, Claim claim) {
  const auto said = answer.at_most ? answer.at_most : answer.collision;
  if (!said && (claim == Claim::complete || !answer.is_answer())) return "-";
  return said.value_or(false) ? "1" : "0";
}

/// The answer of `method`: "filtered", the oracle as trials use it; the name of an exact method; or "all",
/// the answer that all exact methods give. Throws Disagreement for "all" if their answers differ.
const char* answer_by(const std::string& method, const Query& query) {
  if (method == filtered) return show(to_answer(query, decide(query)), Claim::complete);
  if (method == all) {
    const Answers answers = ask_all(query);
    if (!disagreement(query, decide(query), answers).empty()) throw Disagreement(query);
    return show(answers.all().front(), Claim::complete);
  }
  const auto named = [&](const Method& each) { return each.name == method; };
  const auto chosen = std::find_if(methods().begin(), methods().end(), named);
  return show(chosen->ask(query), chosen->claim);
}

std::vector<std::string> choices() {
  std::vector<std::string> names{filtered};
  for (const Method& method : methods()) names.emplace_back(method.name);
  names.emplace_back(all);
  return names;
}

std::string help_on_methods() {
  std::string help =
      fmt::format("{}: the answer that trials use, from the filter or, if the filter is unsure, from {}; ",
                  filtered, methods().front().name);
  for (const Method& method : methods())
    help += fmt::format("{} ({}): {}; ", method.name, name(method.claim), method.about);
  return help + fmt::format(
                    "{}: all of these, compared. A parity method cannot distinguish an even number of roots "
                    "from no root; with certificate, a query without one has the answer -, and the exit code "
                    "is then 1",
                    all);
}

std::string answer(const Query& query, const Options& options) {
  std::string line = answer_by(options.method, query);
  if (options.toi || options.rational) {
    auto time = earliest_time(query);
    line += time ? show(time->enclosure(options.width)) : " inf inf";
    if (options.rational)
      line += !time ? " -" : time->rational().empty() ? " irrational" : " " + time->rational();
  }
  if (options.distance) line += show(minimum_distance(query));
  return line;
}

}  // namespace

void add_oracle(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand(
      "oracle",
      "Decide queries exactly: one line each, 1 for a collision or a distance of at most h, 0 for none");
  options->input.add_to(*command);
  command->add_option("--method", options->method, help_on_methods())
      ->check(CLI::Validator(
          [](const std::string& text) {
            return text == "sturm" ? "'sturm' is gone; use --method certificate, which proves the answer"
                                   : "";
          },
          ""))
      ->check(CLI::IsMember(choices()))
      ->capture_default_str();
  command->add_flag("--toi", options->toi,
                    "Add 'lo hi', which enclose the earliest time of contact; inf inf if there is none");
  command
      ->add_option("--width", options->width,
                   "Largest width of this enclosure; 0: as narrow as doubles allow")
      ->check(CLI::Validator(
          [](const std::string& text) {
            double width = -1;
            std::from_chars(text.data(), text.data() + text.size(), width);
            return width >= 0 && width <= 1
                       ? ""
                       : fmt::format("found '{}', expected a number from 0 to 1", excerpt(text));
          },
          ""))
      ->capture_default_str()
      ->type_name("W");
  command->add_flag("--rational", options->rational,
                    "Add --toi, and the time as a fraction, 'irrational', or '-' if there is none");
  command->add_flag("--distance", options->distance,
                    "Add 'lo hi', which enclose the smallest distance over [0, 1]");
  command->footer(
      "\nNumbers are decimal or C hex floats, separated by blanks or commas; '#' starts a comment.\n"
      "Example: echo '0 0 1 0 0 0 1 0 0 0 1 0  0 0 -1 0 0 0 1 0 0 0 1 0' | "
      "nearmiss oracle --kind vt --toi");
  command->callback([options, &exit_code] {
    try {
      options->input.read([&](const Query& query) {
        const std::string line = answer(query, *options);
        if (line.starts_with('-')) exit_code = exit_found;
        fmt::print("{}\n", line);
      });
    } catch (const Disagreement& disagreement) {
      fmt::print(stderr, "nearmiss: {}\n", disagreement.what());
      exit_code = exit_found;
    }
  });
}

}  // namespace nearmiss::tools
