// nearmiss subjects: lists the CCDs that can be put on trial.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "ccd/error.hpp"
#include "ccd/excerpt.hpp"
#include "ccd/plugin.hpp"
#include "fuzz/subjects/contracted.hpp"
#include "fuzz/subjects/defects.hpp"
#include "fuzz/subjects/ladder/scalars.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "tools/commands.hpp"

namespace nearmiss::tools {

namespace {

/// Prints some lines about a detector.
void print(const DetectorInfo& info) {
  constexpr std::array<const char*, 3> times{"no time", "an estimate of the time",
                                             "a lower bound of the time"};
  std::vector<std::string> kinds_decided;
  for (const Kind kind : kinds)
    if (decides(info, kind)) kinds_decided.emplace_back(short_name(kind));
  fmt::print("{:<23} {}\n", info.name, info.about);
  fmt::print("{:<23} version {}; {}; {} bits; {}; {}{}batches of {}\n", "",
             info.version.empty() ? "?" : info.version, fmt::join(kinds_decided, " and "),
             info.is_narrow ? 24 : 53, times[static_cast<std::size_t>(info.time_sort)],
             info.claims_bound ? "claims a bound; " : "", info.takes_separation ? "takes a separation; " : "",
             info.batch);
  if (const std::string contract = in_words(info.contract); !contract.empty())
    fmt::print("{:<23} presumes: {}\n", "", contract);
}

}  // namespace

void add_subjects(CLI::App& app, int& /*exit_code*/) {
  auto* command =
      app.add_subcommand("subjects", "List the built-in subjects, or describe the detectors of plug-ins");
  auto plugins = std::make_shared<std::vector<std::string>>();
  command->add_option("PLUGIN", *plugins,
                      "Plug-ins whose detectors to describe instead, such as ./plugin.so");
  command->footer(
      "\nA plug-in is a shared object, named by its path, which must contain a slash: ./plugin.so, or one of "
      "its "
      "detectors with options: ./plugin.so:NAME:KEY=VALUE (ccd/nearmiss_subject.h); or a program: "
      "'pipe:COMMAND' "
      "(fuzz/subjects/PROGRAMS.md).");
  command->callback([plugins] {
    for (const std::string& name : *plugins) {
      if (!is_plugin(name))
        throw Error(fmt::format("found '{}', expected a plug-in such as ./plugin.so", excerpt(name)));
      for (const auto& subject : make_any_subjects(name)) print(*plugin_info(*subject));
    }
    if (!plugins->empty()) return;
    for (const SubjectInfo& subject : built_in_subjects())
      fmt::print("{:<23} {}\n", subject.name, subject.about);
    fmt::print("\nbasic, wang and wang-tight over other scalars, NAME:SCALAR, with machine epsilon:\n");
    for (const ladder::Scalar& scalar : named_scalars())
      fmt::print("{:<23} 2^{}\n", "NAME:" + scalar.name, scalar.epsilon_exponent);
    fmt::print("{:<23} 2^(1 - N), N bits, from {} to {}\n", "NAME:pN", ladder::fewest_bits,
               ladder::most_bits);
    fmt::print("\nCCDs with one known defect each, to measure whether a hunt finds it:\n");
    for (const Defect& defect : defects()) fmt::print("{:<23} {}\n", defect.name, defect.about);
  });
}

}  // namespace nearmiss::tools
