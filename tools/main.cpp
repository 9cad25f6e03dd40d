// nearmiss: the command line.
#include <fmt/format.h>
#include <gmp.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <numeric>
#include <regex>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "ccd/query/arithmetic.hpp"
#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "ccd/query/instructions.hpp"
#include "ccd/query/printable.hpp"
#include "fuzz/stop.hpp"
#include "reports/text/shell.hpp"
#include "tools/commands.hpp"
#include "tools/configuration.hpp"
#include "tools/terminal.hpp"

namespace {

constexpr const char* about =
    "nearmiss puts continuous collision detectors (CCDs) on trial: it compares them with an exact oracle, "
    "hunts for\n"
    "collisions that they miss, and measures how far from contact their false alarms are.\n\n"
    "Try: nearmiss demo, then nearmiss fuzz --subject basic,wang --cases 100000";

constexpr const char* exit_codes =
    "\nExit codes: 0 fine; 1 the results have a miss, a late time, a refuted bound, a fault of a subject, a\n"
    "subject that got no query or left most unanswered, an oracle disagreement or a wrong recorded truth,\n"
    "or what --fail-on names: committed, unknown, contract, slow; 2 bad usage, bad input, or output that\n"
    "cannot be written (one line on stderr says what); 130 interrupted, everything so far is saved.\n\n"
    "Environment: NEARMISS_LANES=2, 4 or 8 sets how many doubles are computed side by side, at most as many "
    "as the\n"
    "machine can, which is the default. It changes no answer.";

/// The edit distance: the smallest number of letters to change, add or remove in one word to get the other.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

/// Throws Error if the word is not among the names; the message has the nearest name.
void expect_known(const std::string& what, std::string_view word, const std::vector<std::string>& names,
                  const std::string& help) {
  if (std::ranges::count(names, word) > 0) return;
  const auto nearest =
      std::ranges::min_element(names, {}, [&](const std::string& name) { return edit_distance(name, word); });
  throw nearmiss::Error(fmt::format("found the {} '{}', expected one such as '{}' (see {})", what,
                                    nearmiss::excerpt(word), *nearest, help));
}

void expect_subcommand(const CLI::App& app, std::string_view word) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (!word.starts_with('-')) expect_known("subcommand", word, names, "nearmiss --help");
}

std::string help_for(int argc, char** argv) {
  return argc > 1 && argv[1][0] != '-' ? fmt::format("nearmiss {} --help", argv[1]) : "nearmiss --help";
}

/// Adds the names of a command's own options to `names`. Leaves out the options of its subcommands and of its
/// groups of options.
void add_options(const CLI::App& command, std::vector<std::string>& names) {
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
}

/// Throws Error for the first option that the subcommand does not have.
void expect_options(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  const CLI::App& command = *app.get_subcommand(argv[1]);
  std::vector<std::string> names;
  add_options(command, names);
  for (const CLI::App* group : command.get_subcommands({})) add_options(*group, names);
  add_options(app, names);  // such as --config
  for (int i = 2; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word.starts_with("--") && word != "--")
      expect_known("option", word.substr(0, word.find('=')), names, help_for(argc, argv));
  }
}

/// A message of the command line's parser, with long words cut short. Only words that the user typed are
/// long.
std::string with_short_words(std::string_view text) {
  constexpr std::size_t most = 200;  // all words of the parser's own texts are shorter than this
  std::string result;
  while (!text.empty()) {
    const std::size_t length = std::min(text.find(' '), text.size());
    result += nearmiss::excerpt(text.substr(0, length), most);
    const std::size_t blanks = std::min(text.find_first_not_of(' ', length), text.size()) - length;
    result.append(blanks, ' ');
    text.remove_prefix(length + blanks);
  }
  return result;
}

/// Throws Error if an argument or the value of an option is empty, or consists only of commas. Such an
/// argument is what the shell passes if the user writes a variable that is not set.
void expect_values(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument.empty())
      throw nearmiss::Error(fmt::format("found an empty argument after '{}', expected a value",
                                        nearmiss::excerpt(argv[i - 1])));
    if (argument.find_first_not_of(',') == std::string_view::npos)
      throw nearmiss::Error(
          fmt::format("found an empty list after '{}', expected a value", nearmiss::excerpt(argv[i - 1])));
    if (argument.starts_with("--") && argument.ends_with('='))
      throw nearmiss::Error(fmt::format("found '{}', expected a value", nearmiss::excerpt(argument)));
  }
}

/// Chooses the vector instructions by the number of doubles that they compute at once. `variable` has this
/// number; it is the value of the environment variable NEARMISS_LANES. If `variable` is null or empty, does
/// nothing.
void choose_lanes(const char* variable) {
  if (variable == nullptr || *variable == '\0') return;
  try {
    nearmiss::choose_instructions(variable);
  } catch (const nearmiss::Error& error) {
    throw nearmiss::Error(fmt::format("NEARMISS_LANES: {}", error.what()));
  }
}

/// Prints why the program ends, on one line that a terminal can show.
void print_reason(std::string_view reason) {
  std::fputs(("nearmiss: " + nearmiss::printable(reason) + "\n").c_str(), stderr);
}

/// Throws Error if anything that was printed could not be written.
void expect_output() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw nearmiss::Error(fmt::format("standard output cannot be written: {}", std::strerror(errno)));
}

/// If an interrupted command has a store, prints the command that continues it.
void print_continuation(const CLI::App& command, int argc, char** argv) {
  const CLI::Option* const store = command.get_option_no_throw("--db");
  const CLI::Option* const resume = command.get_option_no_throw("--resume");
  if (store == nullptr || resume == nullptr || store->count() == 0) return;
  std::string again;
  for (int i = 0; i < argc; ++i) again += " " + nearmiss::printable_argument(argv[i]);
  if (resume->count() == 0) again += " --resume";
  std::fputs(("nearmiss: interrupted; to continue:" + again + "\n").c_str(), stderr);
}

std::shared_ptr<const nearmiss::tools::ConfigurationFile> add_configuration(CLI::App& app) {
  const auto file = std::make_shared<nearmiss::tools::ConfigurationFile>("fuzz");
  app.set_config("--config", "", "Read options of fuzz from a TOML file")->group("");
  app.allow_config_extras(CLI::config_extras_mode::error);
  app.config_formatter(file);
  app.get_subcommand("fuzz")->fallthrough();
  return file;
}

bool is_about(std::string_view message, const std::string& option) {
  const std::size_t at = message.find("--" + option);
  const auto is_of_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-'; };
  const std::size_t end = at + option.size() + 2;
  return at != message.npos && (end == message.size() || !is_of_name(message[end]));
}

/// If the configuration file is to blame for `message`, throws Error with the file, the line and the message;
/// otherwise, returns. The file is to blame if it could not be read, or if the message is about an option
/// that is set in the file, and not by an argument.
void refuse_configuration(const CLI::App& app, const nearmiss::tools::ConfigurationFile& configuration,
                          const std::string& message, int argc, char** argv) {
  if (app.get_config_ptr()->count() == 0) return;
  const auto file = app.get_config_ptr()->as<std::string>();
  constexpr std::string_view of_reader = "--config:";
  if (message.starts_with(of_reader))
    throw nearmiss::Error(fmt::format("{}:{}", file, message.substr(of_reader.size())));
  std::vector<std::string> names;
  add_options(*app.get_subcommand("fuzz"), names);
  for (const CLI::App* group : app.get_subcommand("fuzz")->get_subcommands({})) add_options(*group, names);
  for (const auto& [option, line] : configuration.lines()) {
    const auto is_argument = [&](const char* each) {
      return std::string_view(each) == "--" + option ||
             std::string_view(each).starts_with("--" + option + "=");
    };
    if (std::any_of(argv, argv + argc, is_argument)) continue;
    const std::string place = fmt::format("{}:{}: ", file, line);
    try {
      expect_known("option", "--" + option, names, "nearmiss fuzz --help");
    } catch (const nearmiss::Error& error) {
      throw nearmiss::Error(place + error.what());
    }
    static const std::regex choice(R"(: (.*) not in \{(.*)\}$)");  // a message of CLI11
    if (is_about(message, option))
      throw nearmiss::Error(place + std::regex_replace(message, choice, ": found '$1', expected one of $2"));
  }
}

int run(int argc, char** argv) {
  using namespace nearmiss::tools;
  CLI::App app(about, "nearmiss");
  app.require_subcommand(1);
  app.set_help_all_flag("--help-all", "Print the help of every subcommand and exit");
  app.set_version_flag("--version", NEARMISS_VERSION);
  app.footer(exit_codes);

  int exit_code = exit_fine;
  for (const auto add : {add_demo,   add_fuzz,    add_replay,   add_shrink,    add_report,  add_history,
                         add_merge,  add_scene,   add_simulate, add_distance,  add_step,    add_ladder,
                         add_paper,  add_audit,   add_power,    add_tightness, add_bench,   add_family,
                         add_oracle, add_certify, add_verdict,  add_subjects,  add_convert, add_completion})
    add(app, exit_code);
  const auto configuration = add_configuration(app);

  expect_values(argc, argv);
  choose_lanes(std::getenv("NEARMISS_LANES"));
  if (argc > 1) expect_subcommand(app, argv[1]);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool asked = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
    if (asked) {
      app.exit(error);
      expect_output();
      return exit_code;
    }
    expect_options(app, argc, argv);
    const std::string message = with_short_words(error.what());
    refuse_configuration(app, *configuration, message, argc, argv);
    throw nearmiss::Error(fmt::format("{} (see {})", message, help_for(argc, argv)));
  } catch (const nearmiss::Error& error) {
    refuse_configuration(app, *configuration, error.what(), argc, argv);
    throw;
  }
  expect_output();
  if (exit_code == exit_interrupted) print_continuation(*app.get_subcommands().front(), argc, argv);
  return exit_code;
}

/// Keeps freed memory for later use. By default, the C library returns freed memory to the system, which
/// takes a tenth of the time of a fast campaign. If a program sets the threshold for returning memory, the C
/// library stops adapting another size: the size from which a block of memory gets a mapping of its own
/// (mmap). Therefore this function sets the other size, too, to its maximum.
void keep_freed_memory() {
  mallopt(M_TRIM_THRESHOLD, 64 << 20);  // bytes of each thread's memory
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
}

/// Ends the program at once; only the results that were added since the last save are lost. An exception
/// would unwind through code of CGAL and GMP, and leave the numbers of these libraries damaged.
[[noreturn]] void end_without_memory() {
  constexpr std::string_view reason = "nearmiss: found too little memory\n";
  (void)!write(STDERR_FILENO, reason.data(), reason.size());
  _exit(nearmiss::tools::exit_bad_input);
}

void* or_end(void* memory) {
  if (memory == nullptr) end_without_memory();
  return memory;
}

/// Makes the program end with end_without_memory() if C++ or GMP cannot allocate memory.
void end_if_memory_runs_out() {
  std::set_new_handler(end_without_memory);
  mp_set_memory_functions(
      [](std::size_t size) { return or_end(std::malloc(size)); },
      [](void* old, std::size_t, std::size_t size) { return or_end(std::realloc(old, size)); },
      [](void* old, std::size_t) { std::free(old); });
}

}  // namespace

int main(int argc, char** argv) {
  nearmiss::tools::occupy_standard_streams();
  nearmiss::tools::end_on_signals();
  if (const std::string odd = nearmiss::odd_arithmetic(); !odd.empty())
    std::fprintf(
        stderr,
        "nearmiss: found arithmetic that %s, expected rounding to nearest with subnormals; changed to that\n",
        odd.c_str());
  keep_freed_memory();
  end_if_memory_runs_out();
  // Sets the rounding mode and the treatment of subnormals before any thread starts, because a thread
  // inherits them from the thread that starts it.
  const nearmiss::PlainArithmetic plain;
  try {
    return run(argc, argv);
  } catch (const nearmiss::Stopped&) {  // the program was stopped before it had any results to save
    return nearmiss::tools::exit_interrupted;
  } catch (const std::filesystem::filesystem_error& error) {
    print_reason(fmt::format("{}: {}", error.path1().string(), error.code().message()));
  } catch (const std::system_error& error) {
    // If fmt::print throws the exception, its message does not say that the stream is standard output.
    if (std::ferror(stdout) != 0)
      print_reason(fmt::format("standard output cannot be written: {}", error.code().message()));
    else
      print_reason(error.what());
  } catch (const std::bad_alloc&) {
    print_reason("found too little memory");
  } catch (const std::exception& error) {
    print_reason(error.what());
  }
  return nearmiss::tools::exit_bad_input;
}
