// nearmiss certify: proofs of the oracle's answers.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>

#include "oracle/certificates/certificate.hpp"
#include "tools/arguments.hpp"
#include "tools/commands.hpp"

namespace nearmiss::tools {

namespace {

struct Options {
  QueryInput input;
  bool toi = false;
  bool distance = false;
};

Certificates statements_about(const Query& query, const Options& options) {
  Certificates all;
  const auto add = [&](Certificates&& some) { std::ranges::move(some, std::back_inserter(all)); };
  if (options.toi) add(certify_time(query));
  if (options.distance) add(certify_distance(query));
  if (all.empty()) all.push_back(certify(query));
  return all;
}

/// The text that is printed if a statement about a query has no certificate: the reason.
const char* why_none(const Query& query) {
  return query.separation > 0
             ? "no proof was found: perhaps the distance reaches h at an irrational time, and neither falls "
               "below it nor stays at it"
             : "no proof was found";
}

}  // namespace

void add_certify(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<Options>();
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

}  // namespace nearmiss::tools
