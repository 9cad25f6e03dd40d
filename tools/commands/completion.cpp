// nearmiss completion: lets a shell complete the command line.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <string_view>
#include <vector>

#include "ccd/query/error.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/subjects/built_in.hpp"
#include "fuzz/subjects/peers.hpp"
#include "tools/commands.hpp"

namespace nearmiss::tools {

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

/// The families that have a parameter.
std::vector<std::string> sweep_names() {
  std::vector<std::string> names;
  for (const Family& family : all_families())
    if (family.parameter) names.emplace_back(family.name);
  return names;
}

/// A completion script for bash. It completes subcommands, options, the last name in a list of families,
/// sweeps or subjects (which may be files), and files everywhere else. Bash passes "--option=value" to it as
/// three words.
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
