// nearmiss oracle, certify and verdict: exact answers to queries, proofs of these answers, and the answers of
// one subject.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "corpus/query_text.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "fuzz/trial/judge.hpp"
#include "fuzz/trial/signatures.hpp"
#include "oracle/agreement/answers.hpp"
#include "oracle/agreement/checked.hpp"
#include "oracle/certificates/certificate.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"
#include "tools/arguments.hpp"
#include "tools/commands.hpp"

namespace nearmiss::tools {

namespace {

// Values that --method takes in addition to the names of methods.
constexpr const char* filtered = "filtered";
constexpr const char* all_methods = "all";

struct OracleOptions {
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

/// Returns "1" if the primitives touch or come within the separation, otherwise "0". If the smallest distance
/// is exactly the separation, returns "1", as the library does. Returns "-" if a method that decides all
/// collisions (Claim::complete) cannot tell, or if another method, such as root parity, gives no answer to
/// the query.
const char* show(const Answer& answer, Claim claim) {
  const auto said = answer.at_most ? answer.at_most : answer.collision;
  if (!said && (claim == Claim::complete || !answer.is_answer())) return "-";
  return said.value_or(false) ? "1" : "0";
}

/// The answer of the method that `method` names. "filtered" is the oracle as trials use it; "all" stands for
/// all exact methods; any other name is that of one exact method. For "all", throws Disagreement if the
/// answers of the exact methods differ.
const char* answer_by(const std::string& method, const Query& query) {
  if (method == filtered) return show(to_answer(query, decide(query)), Claim::complete);
  if (method == all_methods) {
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
  names.emplace_back(all_methods);
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
                    all_methods);
}

std::string answer(const Query& query, const OracleOptions& options) {
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
  auto options = std::make_shared<OracleOptions>();
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

namespace {

struct CertifyOptions {
  QueryInput input;
  bool toi = false;
  bool distance = false;
};

Certificates statements_about(const Query& query, const CertifyOptions& options) {
  Certificates all;
  const auto add = [&](Certificates&& some) { std::ranges::move(some, std::back_inserter(all)); };
  if (options.toi) add(certify_time(query));
  if (options.distance) add(certify_distance(query));
  if (all.empty()) all.push_back(certify(query));
  return all;
}

const char* why_none(const Query& query) {
  return query.separation > 0
             ? "no proof was found: perhaps the distance reaches h at an irrational time, and neither falls "
               "below it nor stays at it"
             : "no proof was found";
}

}  // namespace

void add_certify(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<CertifyOptions>();
  auto* command = app.add_subcommand(
      "certify",
      "Prove the oracle's answers: one certificate a line, in JSON, which tools/certificates/ checks");
  options->input.add_to(*command);
  command->add_flag(
      "--toi", options->toi,
      "Prove the enclosure of the earliest time: nothing happens before it, and something in it");
  command->add_flag("--distance", options->distance, "Prove the bounds of the smallest distance over [0, 1]");
  command->footer(
      "\nIf a statement has no certificate, its line has \"claim\":null and the reason, and the exit code is "
      "1.\n"
      "Example: nearmiss family uniform --kind vt --count 9 | nearmiss certify --kind vt > c.jsonl");
  command->callback([options, &exit_code] {
    std::size_t number = 0;
    options->input.read([&](const Query& query) {
      ++number;
      for (const auto& each : statements_about(query, *options)) {
        if (!each) exit_code = exit_found;
        const std::string rest =
            each ? each->substr(1) : fmt::format(R"("claim":null,"why":"{}"}})", why_none(query));
        fmt::print("{{\"query\":\"{}\",{}\n", number, rest);
      }
    });
  });
}

namespace {

struct VerdictOptions {
  QueryInput input;
  std::string subject = "wang", bound;
  PluginLimitOptions limits;
  bool distance_bound = false;
  bool rounded = false;
};

/// The distance bound by which a false positive of the subject is judged. Returns the bound that the subject
/// claims (" 0x1p-9 claimed") or, if the subject claims none, wang's bound (" 0x1p-9 wang").
std::string show_distance_bound(const Subject& subject, const Judge& judge, const Query& query) {
  const BoundAnswer answer = judge.ask_unit(query);
  if (answer.fault == Fault::error)
    throw Error(fmt::format("{}: found the distance bound {}, expected 0 or more", subject.name(),
                            std::isnan(answer.bound) ? "NaN" : fmt::format("{}", answer.bound)));
  if (answer.fault != Fault::none)
    throw Error(fmt::format("{}: no distance bound: {}", subject.name(),
                            fault_signature(subject, query.kind, answer.fault, answer.fault_code)));
  return fmt::format(" {} {}", to_hex(answer.bound), subject.claims_bound() ? "claimed" : "wang");
}

void ask(const VerdictOptions& options) {
  const auto subject = make_any_subject(options.subject, parse_bound(options.bound), options.limits.limits());
  const Judge judge(*subject);
  options.input.read([&](const Query& query) {
    expect_kind(*subject, query.kind);
    if (query.separation > 0) expect_separation(*subject, std::array{query.kind});
    const Verdict verdict = subject->decide(query);
    if (verdict.fault != Fault::none)
      throw Error(fmt::format("{}: no answer: {}", subject->name(),
                              fault_signature(query.kind, verdict, subject->fault_text(verdict))));
    std::string line = "0";
    if (verdict.hit)
      line = fmt::format("1 {} {}", stage_names[static_cast<std::size_t>(verdict.stage)],
                         std::isfinite(verdict.time) ? to_hex(verdict.time) : "nan");
    const Query judged = subject->rounded(query);
    if (options.distance_bound) line += show_distance_bound(*subject, judge, judged);
    if (options.rounded) line += " " + to_line(judged);
    fmt::print("{}\n", line);
  });
}

}  // namespace

void add_verdict(CLI::App& app, int& /*exit_code*/) {
  auto options = std::make_shared<VerdictOptions>();
  auto* command = app.add_subcommand(
      "verdict",
      "Let one subject decide queries: one line each, 0, or 1 with the accepting stage and the time");
  options->input.add_to(*command);
  command
      ->add_option("--subject", options->subject, "A name (see nearmiss subjects), or the path of a plug-in")
      ->capture_default_str();
  add_bound_option(*command, options->bound);
  options->limits.add_to(*command);
  command->add_flag(
      "--distance-bound", options->distance_bound,
      "Add the distance bound of false positives, and 'claimed', or 'wang' if it is wang's bound "
      "because the subject claims none");
  command->add_flag("--rounded", options->rounded,
                    "Add the query as the subject rounds it, by which its answer is judged, with the "
                    "separation unless it is 0");
  command->footer(
      "\nExample: echo '0 0 1 0 0 0 1 0 0 0 1 0  0 0 -1 0 0 0 1 0 0 0 1 0' | "
      "nearmiss verdict --kind vt --subject wang");
  command->callback([options] { ask(*options); });
}

}  // namespace nearmiss::tools
