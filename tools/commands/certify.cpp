// nearmiss certify: proofs of the oracle's answers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "oracle/certificates/certificate.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"
#include "tools/arguments.hpp"
#include "tools/commands.hpp"

namespace nearmiss::tools {

namespace {

struct Options {
  QueryInput input;
  bool toi = false;
  bool distance = false;
};

using Statement = std::optional<std::string>;

/// Proofs that nothing happens before t*, and that something happens in its enclosure.
std::vector<Statement> of_time(const Query& query) {
  auto time = earliest_time(query);
  if (!time) return {certify(query)};
  const Enclosure t = time->enclosure();
  std::vector<Statement> statements;
  if (t.lo > 0) statements.push_back(certify_apart(query, {0, t.lo, true}));
  statements.push_back(certify_meets(query, {t.lo, t.hi}));
  return statements;
}

/// Proofs that the smallest distance is at least lo, and at most hi.
std::vector<Statement> of_distance(const Query& query) {
  const Enclosure distance = minimum_distance(query);
  std::vector<Statement> statements;
  if (distance.lo > 0) statements.push_back(certify_apart(with_separation(query, distance.lo), {}, false));
  if (std::isfinite(distance.hi))
    statements.push_back(certify_meets(with_separation(query, distance.hi), {}));
  return statements;
}

std::vector<Statement> statements_about(const Query& query, const Options& options) {
  std::vector<Statement> all;
  const auto add = [&](std::vector<Statement>&& some) { std::ranges::move(some, std::back_inserter(all)); };
  if (options.toi) add(of_time(query));
  if (options.distance) add(of_distance(query));
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
      for (const Statement& each : statements_about(query, *options)) {
        if (!each) exit_code = exit_found;
        const std::string_view rest =
            each ? std::string_view(*each).substr(1) : R"("claim":null,"why":"no proof was found"})";
        fmt::print("{{\"query\":\"{}\",{}\n", number, rest);
      }
    });
  });
}

}  // namespace nearmiss::tools
