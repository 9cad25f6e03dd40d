// nearmiss certify: proofs of the oracle's answers.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string_view>

#include "oracle/certificates/certificate.hpp"
#include "oracle/certificates/statements.hpp"
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
  command->callback([options, &exit_code] {
    std::size_t number = 0;
    options->input.read([&](const Query& query) {
      ++number;
      for (const auto& each : statements_about(query, *options)) {
        if (!each) exit_code = exit_found;
        const std::string_view rest =
            each ? std::string_view(*each).substr(1) : R"("claim":null,"why":"no proof was found"})";
        fmt::print("{{\"query\":\"{}\",{}\n", number, rest);
      }
    });
  });
}

}  // namespace nearmiss::tools
