#include "tools/fail_on.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "tools/commands.hpp"

namespace nearmiss::tools {

namespace {

/// The kinds of failure that give exit code 1 only on request.
Failures on_request() {
  Failures found;
  for (const FailureKind kind : all_failures())
    if (failure_info(kind).on_request) found.insert(kind);
  return found;
}

/// "unknown, contract, slow"
std::string names_on_request() {
  std::vector<std::string_view> names;
  for (const FailureKind kind : on_request()) names.push_back(name(kind));
  return fmt::format("{}", fmt::join(names, ", "));
}

FailureKind find_failure(const std::string& text) {
  const auto has_name = [&](FailureKind kind) { return name(kind) == text; };
  const Failures selectable = on_request();
  const auto found = std::find_if(selectable.begin(), selectable.end(), has_name);
  if (found != selectable.end()) return *found;
  const bool is_usual = std::any_of(usual_failures().begin(), usual_failures().end(), has_name);
  throw Error(fmt::format("--fail-on: found '{}'{}, expected some of {}", excerpt(text),
                          is_usual ? ", which always gives exit code 1" : "", names_on_request()));
}

}  // namespace

void FailOnOption::add_to(CLI::App& command) {
  command
      .add_option_function<std::vector<std::string>>(
          "--fail-on",
          [this](const std::vector<std::string>& given) {
            for (const std::string& each : given) failures_.insert(find_failure(each));
          },
          fmt::format("Failures, separated by commas, that are to give exit code 1, too: {}",
                      names_on_request()))
      ->delimiter(',')
      ->type_name("A,B,...");
}

int FailOnOption::exit_code(const Statistics& statistics) const {
  return has_failed(statistics, failures_) ? exit_found : exit_fine;
}

}  // namespace nearmiss::tools
