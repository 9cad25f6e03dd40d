// nearmiss subjects and completion: the names that the command line knows, for people and for shells.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "ccd/subjects/plugin.hpp"
#include "corpus/query_text.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/libfuzzer/targets.hpp"
#include "fuzz/subjects/built_in.hpp"
#include "fuzz/subjects/contracted.hpp"
#include "fuzz/subjects/defects.hpp"
#include "fuzz/subjects/ladder/scalars.hpp"
#include "fuzz/subjects/peers.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "tools/arguments.hpp"
#include "tools/commands.hpp"

namespace nearmiss::tools {

namespace {

/// Says for which kinds a plug-in takes separations; "" if it takes none.
std::string separations_of(const DetectorInfo& info) {
  if (info.separation_kinds == 0) return "";
  if (info.separation_kinds == info.kinds) return "takes a separation; ";
  return fmt::format("takes a separation for {}; ", names_of_kinds(info.separation_kinds, " and "));
}

/// Says for which kinds a plug-in gives distances, and for which kinds it filters steps; "" if it does
/// neither.
std::string further_questions(const DetectorInfo& info) {
  std::string text;
  for (const auto& [what, of] :
       {std::pair{"gives distances", info.distance_kinds}, std::pair{"filters steps", info.step_kinds}})
    if (of != 0) text += fmt::format("{} of {}; ", what, names_of_kinds(of, " and "));
  return text;
}

void print(const Subject& subject) {
  const DetectorInfo& info = *plugin_info(subject);
  constexpr std::array<const char*, 4> times{"no time", "an estimate of the time",
                                             "a lower bound of the time", "a time to which the step is free"};
  fmt::print("{:<23} {}\n", subject.name(), info.about);
  const std::string kinds = info.kinds == 0 ? "decides nothing" : names_of_kinds(info.kinds, " and ");
  fmt::print("{:<23} version {}; {}; {} bits; {}; {}{}{}batches of {}\n", "",
             info.version.empty() ? "?" : info.version, kinds, info.is_narrow ? 24 : 53,
             times[static_cast<std::size_t>(info.time_sort)], info.claims_bound ? "claims a bound; " : "",
             separations_of(info), further_questions(info), info.batch);
  if (const std::string contract = in_words(info.contract); !contract.empty())
    fmt::print("{:<23} presumes: {}\n", "", contract);
}

void describe(const std::string& name) {
  if (!plugin_named(name))
    throw Error(
        fmt::format("found '{}', expected a plug-in such as ./plugin.so, or a published CCD (nearmiss "
                    "subjects lists them)",
                    excerpt(name)));
  for (const auto& subject : make_any_subjects(name)) print(*subject);
}

/// Prints a line for each pair of a subject and a libFuzzer target that can hunt for the subject's failures.
/// The line has the target, and the subject in the form that the target takes. For a published CCD, this form
/// is the path of the CCD's plug-in. Prints nothing for a program, because libFuzzer sees no coverage of
/// another process. Throws Error if two subjects have the same name.
void print_targets(const std::vector<std::string>& texts) {
  std::vector<std::unique_ptr<Subject>> subjects;
  for (const std::string& text : texts) {
    expect_printable(text);
    subjects.push_back(make_any_subject(text));
  }
  tell_apart(subjects);
  for (const auto& subject : subjects) {
    const std::string text = text_of(*subject);
    if (is_program(SubjectText::parse(text).subject)) continue;
    for (const libfuzzer::PromiseTarget& target : libfuzzer::targets_for(*subject))
      fmt::print("{} {}\n", target.name, text);
  }
}

/// Says what a published CCD is, or why it cannot be put on trial.
std::string about(const Peer& peer) {
  if (!is_built(peer)) return fmt::format("not built: {}", how_to_build(peer));
  try {
    return plugin_info(*make_any_subject(peer.name))->about;
  } catch (const Error& error) {
    return error.what();
  }
}

void list_all() {
  for (const SubjectInfo& subject : built_in_subjects())
    fmt::print("{:<23} {}\n", subject.name, subject.about);
  fmt::print("\nPublished CCDs (fuzz/subjects/peers/README.md):\n");
  for (const Peer& peer : peers()) fmt::print("{:<23} {}\n", peer.name, about(peer));
  fmt::print("\nbasic, wang and wang-tight over other scalars, NAME:SCALAR, with machine epsilon:\n");
  for (const ladder::Scalar& scalar : named_scalars())
    fmt::print("{:<23} 2^{}\n", "NAME:" + scalar.name, scalar.epsilon_exponent);
  fmt::print("{:<23} 2^(1 - N), N bits, from {} to {}\n", "NAME:pN", ladder::fewest_bits, ladder::most_bits);
  fmt::print("\nCCDs with one known defect each, to measure whether a hunt finds it:\n");
  for (const Defect& defect : defects()) fmt::print("{:<23} {}\n", defect.name, defect.about);
}

}  // namespace

void add_subjects(CLI::App& app, int& /*exit_code*/) {
  auto* command = app.add_subcommand(
      "subjects",
      "List the subjects that have names, or describe the detectors of plug-ins and published CCDs");
  struct Options {
    std::vector<std::string> plugins;
    bool peers = false, targets = false;
  };
  auto options = std::make_shared<Options>();
  command->add_option("PLUGIN", options->plugins,
                      "Plug-ins and published CCDs whose detectors to describe instead, such as ./plugin.so");
  command->add_flag("--peers", options->peers,
                    "Print only the names of the published CCDs that are built, one a line");
  command->add_flag(
      "--targets", options->targets,
      "Print instead the libFuzzer targets that hunt these subjects, one a line: TARGET SUBJECT");
  command->footer(
      "\nA plug-in is a shared object, named by its path, which must contain a slash: ./plugin.so, or one of "
      "its "
      "detectors with options: ./plugin.so:NAME:KEY=VALUE (ccd/nearmiss_subject.h); or a program: "
      "'pipe:COMMAND' "
      "(fuzz/subjects/PROGRAMS.md). NAME=SUBJECT gives any subject another name: new=./plugin.so.");
  command->callback([options] {
    if (options->targets)
      print_targets(options->plugins);
    else
      for (const std::string& name : options->plugins) describe(name);
    if (options->peers)
      for (const Peer& peer : peers())
        if (is_built(peer)) fmt::print("{}\n", peer.name);
    if (options->plugins.empty() && !options->peers) list_all();
  });
}

namespace {

/// The long options of a subcommand, including those in option groups.
std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* group : command.get_subcommands({}))
    for (std::string& name : options_of(*group))
      if (name != "--help" && name != "--help-all") names.push_back(std::move(name));
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::vector<std::string> subject_names() {
  std::vector<std::string> names;
  for (const SubjectInfo& subject : built_in_subjects()) names.emplace_back(subject.name);
  for (const Peer& peer : peers()) names.emplace_back(peer.name);
  return names;
}

std::vector<std::string> family_names() {
  std::vector<std::string> names;
  for (const Family& family : all_families()) names.emplace_back(family.name);
  return names;
}

std::vector<std::string> sweep_names() {
  std::vector<std::string> names;
  for (const Family& family : all_families())
    if (family.parameter) names.emplace_back(family.name);
  return names;
}

/// A completion script for bash. The script completes subcommands and options. In a list of families, sweeps
/// or subjects (which may be files), it completes the last name; everywhere else, it completes the names of
/// files. Bash passes "--option=value" to the script as three words.
std::string bash_script(const CLI::App& app) {
  std::vector<std::string> names;
  std::string options;
  for (const CLI::App* command : app.get_subcommands({})) {
    names.push_back(command->get_name());
    options +=
        fmt::format("    {}) words='{}' ;;\n", command->get_name(), fmt::join(options_of(*command), " "));
  }
  return fmt::format(
      R"(_nearmiss() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} words=
  COMPREPLY=()
  [[ $word != = ]] || word=
  [[ $before != = ]] || before=${{COMP_WORDS[COMP_CWORD-2]}}
  if ((COMP_CWORD == 1)); then
    COMPREPLY=($(compgen -W '{} --help --version' -- "$word"))
    return
  fi
  case $before in
    --subject) words='{}' ;;
    --family) words='all vertices {}' ;;
    --sweep) words='all vertices {}' ;;
  esac
  if [[ -n $words ]]; then
    local first= action=
    [[ $word != *,* ]] || first=${{word%,*}},
    [[ $before != --subject ]] || action='-f'
    COMPREPLY=($(compgen -W "$words" $action -P "$first" -- "${{word##*,}}"))
    return
  fi
  [[ $word == -* ]] || return
  case ${{COMP_WORDS[1]}} in
{}  esac
  COMPREPLY=($(compgen -W "$words" -- "$word"))
}}
complete -o bashdefault -o default -F _nearmiss nearmiss
)",
      fmt::join(names, " "), fmt::join(subject_names(), " "), fmt::join(family_names(), " "),
      fmt::join(sweep_names(), " "), options);
}

void run(const CLI::App& app, std::string_view shell) {
  if (shell == "zsh")
    fmt::print("#compdef nearmiss\nautoload -U +X bashcompinit && bashcompinit\n");
  else if (shell != "bash")
    throw Error(fmt::format("SHELL: found '{}', expected bash or zsh", shell));
  fmt::print("{}", bash_script(app));
  // zsh reads an installed script only when it first completes a nearmiss command, so the script must also do
  // this first completion.
  if (shell == "zsh")
    fmt::print(
        "[[ ${{zsh_eval_context[-1]}} != loadautofunc ]] || _bash_complete -o bashdefault -o default -F "
        "_nearmiss\n");
}

}  // namespace

void add_completion(CLI::App& app, int& /*exit_code*/) {
  auto shell = std::make_shared<std::string>();
  auto* command =
      app.add_subcommand("completion", "Print a script that lets bash or zsh complete command lines");
  command->add_option("SHELL", *shell, "bash or zsh")->required();
  command->footer(
      "\nFor bash:  nearmiss completion bash > ~/.local/share/bash-completion/completions/nearmiss\n"
      "For zsh:   source <(nearmiss completion zsh)");
  command->callback([&app, shell] { run(app, *shell); });
}

}  // namespace nearmiss::tools
