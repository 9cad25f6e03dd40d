// nearmiss subjects: lists the CCDs that can be put on trial.
#include <fmt/format.h>

#include "fuzz/subjects/defects.hpp"
#include "fuzz/subjects/ladder/scalars.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "tools/commands.hpp"

namespace nearmiss::tools {

void add_subjects(CLI::App& app, int& /*exit_code*/) {
  auto* command = app.add_subcommand("subjects", "List the built-in subjects");
  command->footer(
      "\nA plug-in is named by its path, which must contain a slash: ./plugin.so (see "
      "ccd/nearmiss_subject.h).");
  command->callback([] {
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
