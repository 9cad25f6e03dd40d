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

/// "unknown, contract, slow"
std::string names_on_request() {
  std::vector<std::string_view> names;
  for (const FailureKind kind : all_failures())
    if (failure_info(kind).on_request) names.push_back(name(kind));
  return fmt::format("{}", fmt::join(names, ", "));
}

FailureKind find_failure(const std::string& text) {
  const Failures& all = all_failures();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](FailureKind kind) { return name(kind) == text; });
  const bool is_known = found != all.end();
  if (is_known && failure_info(*found).on_request) return *found;
  throw Error(fmt::format("--fail-on: found '{}'{}, expected some of {}", excerpt(text),
                          is_known ? ", which always gives exit code 1" : "", names_on_request()));
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
