// nearmiss: the command line.
#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "ccd/arithmetic.hpp"
#include "ccd/error.hpp"
#include "tools/commands.hpp"

namespace {

constexpr const char* about =
    "nearmiss puts continuous collision detectors (CCDs) on trial: it compares them with an exact oracle, "
    "hunts for\n"
    "collisions that they miss, and measures how far from contact their false alarms are.\n\n"
    "Try: nearmiss fuzz --subject basic,wang --cases 100000";

constexpr const char* exit_codes =
    "\nExit codes: 0 fine; 1 a false negative, a refuted bound or an oracle disagreement was found;\n"
    "2 bad usage or bad input (one line on stderr says what); 130 interrupted, everything so far is saved.";

int run(int argc, char** argv) {
  using namespace nearmiss::tools;
  CLI::App app(about, "nearmiss");
  app.require_subcommand(1);
  app.set_help_all_flag("--help-all", "Print the help of every subcommand and exit");
  app.set_version_flag("--version", NEARMISS_VERSION);
  app.footer(exit_codes);

  int exit_code = exit_fine;
  for (const auto add :
       {add_fuzz, add_replay, add_shrink, add_report, add_merge, add_scene, add_ladder, add_audit, add_power,
        add_tightness, add_bench, add_family, add_oracle, add_verdict, add_subjects})
    add(app, exit_code);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool asked = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
    if (asked) return app.exit(error);
    throw nearmiss::Error(fmt::format("{} (see nearmiss --help)", error.what()));
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  if (const std::string odd = nearmiss::odd_arithmetic(); !odd.empty())
    std::fprintf(
        stderr,
        "nearmiss: found arithmetic that %s, expected rounding to nearest with subnormals; changed to that\n",
        odd.c_str());
  // The arithmetic is set before any thread starts, because a thread inherits it from the thread that starts
  // it.
  const nearmiss::PlainArithmetic plain;
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "nearmiss: %s\n", error.what());
    return nearmiss::tools::exit_bad_input;
  }
}
