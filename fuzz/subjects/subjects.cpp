#include "fuzz/subjects/subjects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "ccd/query/error.hpp"
#include "ccd/subjects/plugin.hpp"
#include "fuzz/subjects/forwarding_subject.hpp"
#include "fuzz/subjects/isolation/plugin_code.hpp"
#include "fuzz/subjects/peers.hpp"
#include "reports/text/shell.hpp"

namespace nearmiss {

namespace {

using Subjects = std::vector<std::unique_ptr<Subject>>;

/// The plug-in that the text `subject` (without NAME=) names; nothing if the text names no plug-in.
std::optional<std::string> plugin_of(std::string_view subject) {
  return is_plugin(subject) ? std::string(subject) : plugin_of_peer(subject);
}

std::unique_ptr<Subject> make_built_in_or_refuse(std::string_view name, std::optional<double> given_bound) {
  auto subject = try_make_built_in(name, given_bound);
  if (subject) return subject;
  auto known = built_in_subjects();
  for (const Peer& peer : peers()) known.push_back({.name = peer.name, .about = {}});
  refuse_subject(name, known);
}

/// The file's name without its extension: "v2" for "lib/v2.py", "v2.so" and "v2.so.1".
std::string stem_of(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  const std::size_t shared_object = name.find(".so.");
  return shared_object == std::string::npos ? file.stem().string() : name.substr(0, shared_object);
}

/// The last file that a program's command names; "" if the command names no file.
std::string file_of_program(std::string_view program) {
  const auto files = isolation::files_of_program(program.substr(program_prefix.size()));
  return files.empty() ? "" : files.back();
}

/// Makes a name from a plug-in's file: FILE, or FILE.DETECTOR if the text of the subject chooses a detector.
/// If this name cannot be a NAME, or is the name of a built-in subject, makes the name DETECTOR-FILE instead.
/// Returns "" if there is no file, or if neither name can be used.
std::string name_of_file(const Subject& subject) {
  const auto plugin = plugin_identity(subject);
  if (!plugin) return "";
  const bool of_program = is_program(plugin->path);
  const PluginName parsed =
      of_program ? PluginName{file_of_program(plugin->path), "", ""} : PluginName::parse(plugin->path);
  const std::string stem = stem_of(parsed.path);
  const std::string detector = own_name(subject);
  const std::string chosen = parsed.subject.empty() ? "" : "." + detector;
  if (!stem.empty())
    for (const std::string& name : {stem + chosen, detector + "-" + stem})
      if (is_given_name(name) && !is_built_in_name(name)) return name;
  return "";
}

/// Whether a plug-in or a renamed subject has the name of a built-in subject or of another published CCD.
/// With such a name, a merge of campaigns would add up the results of two different subjects.
bool takes_built_in_name(const Subject& subject) {
  const auto plugin = plugin_identity(subject);
  const bool is_renamed = !given_name(subject).empty();
  if ((!plugin && !is_renamed) || !is_built_in_name(subject.name())) return false;
  const auto own = peer_named(subject.name());
  std::error_code unknown;
  return is_renamed || !own || !plugin || is_program(plugin->path) ||
         !std::filesystem::equivalent(PluginName::parse(plugin->path).path, path_of(*own), unknown);
}

}  // namespace

bool is_built_in_name(std::string_view name) {
  return try_make_built_in(name.substr(0, name.find_first_of(":@"))) != nullptr || peer_named(name);
}

std::optional<std::string> plugin_named(std::string_view text) {
  return plugin_of(SubjectText::parse(text).subject);
}

std::unique_ptr<Subject> make_any_subject(std::string_view text, std::optional<double> given_bound,
                                          const isolation::PluginLimits& limits) {
  const auto [name, subject] = SubjectText::parse(text);
  const auto plugin = plugin_of(subject);
  return named(plugin ? make_isolated_plugin(*plugin, limits) : make_built_in_or_refuse(subject, given_bound),
               name, plugin.has_value());
}

Subjects make_any_subjects(std::string_view text, std::optional<double> given_bound,
                           const isolation::PluginLimits& limits) {
  const auto plugin = plugin_named(text);
  if (plugin && SubjectText::parse(text).name.empty()) return make_isolated_plugins(*plugin, limits);
  Subjects subjects;
  subjects.push_back(make_any_subject(text, given_bound, limits));
  return subjects;
}

void tell_apart(Subjects& subjects) {
  std::vector<std::string> names;
  std::map<std::string, int> times;
  for (const auto& subject : subjects) ++times[names.emplace_back(subject->name())];
  for (auto& subject : subjects)
    if ((times.at(subject->name()) > 1 || takes_built_in_name(*subject)) && given_name(*subject).empty())
      if (const std::string name = name_of_file(*subject); !name.empty())
        subject = named(std::move(subject), name, true);
  std::set<std::string> seen;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const std::string another = shell_quoted("NAME=" + SubjectText::parse(text_of(*subjects[i])).subject);
    if (takes_built_in_name(*subjects[i]))
      throw Error(
          fmt::format("found the name '{}', which a built-in subject has, expected another, such as {}",
                      names[i], another));
    if (!seen.insert(subjects[i]->name()).second)
      throw Error(fmt::format("found two subjects named '{}', expected different names, such as {}", names[i],
                              another));
  }
}

std::string own_name(const Subject& subject) {
  const std::string name = innermost(subject).name();
  return name.substr(0, name.find(':'));
}

std::string text_of(const Subject& subject) {
  const std::string name = given_name(subject);
  const auto plugin = plugin_identity(subject);
  return (name.empty() ? "" : name + "=") + (plugin ? plugin->path : innermost(subject).name());
}

}  // namespace nearmiss
