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

/// The names of the failures that count only on request: "unknown, contract, slow".
std::string names_on_request() {
  std::vector<std::string_view> names;
  for (const FailureKind kind : all_failures())
    if (failure_info(kind).on_request) names.push_back(name(kind));
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Whether a text names a fault; --fail-on need not name faults, because they always count.
bool is_fault(const std::string& text) {
  const auto found = std::find(fault_names.begin(), fault_names.end(), text);
  return found != fault_names.end() &&
         failure_of({.verdict = {.fault = static_cast<Fault>(found - fault_names.begin())}}) ==
             FailureKind::fault;
}

FailureKind find_failure(const std::string& text) {
  const Failures& all = all_failures();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](FailureKind kind) { return name(kind) == text; });
  if (found != all.end() && failure_info(*found).on_request) return *found;
  const bool fails = found != all.end() || is_fault(text);
  throw Error(fmt::format("--fail-on: found '{}'{}, expected some of {}", excerpt(text),
                          fails ? ", which always gives exit code 1" : "", names_on_request()));
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
