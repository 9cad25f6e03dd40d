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

FailureKind find_failure(const std::string& text) {
  const Failures& all = all_failures();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](FailureKind kind) { return name(kind) == text; });
  if (found != all.end()) return *found;
  std::vector<std::string_view> names;
  for (const FailureKind kind : all) names.push_back(name(kind));
  throw Error(
      fmt::format("--fail-on: found '{}', expected some of {}", excerpt(text), fmt::join(names, ", ")));
}

}  // namespace

void FailOnOption::add_to(CLI::App& command) {
  std::vector<std::string_view> names;
  for (const FailureKind kind : all_failures())
    if (failure_info(kind).on_request) names.push_back(name(kind));
  command
      .add_option_function<std::vector<std::string>>(
          "--fail-on",
          [this](const std::vector<std::string>& given) {
            for (const std::string& each : given) failures_.insert(find_failure(each));
          },
          fmt::format("Failures, separated by commas, that are to give exit code 1, too: {}",
                      fmt::join(names, ", ")))
      ->delimiter(',')
      ->type_name("A,B,...");
}

int FailOnOption::exit_code(const Statistics& statistics) const {
  return has_failed(statistics, failures_) ? exit_found : exit_fine;
}

}  // namespace nearmiss::tools
