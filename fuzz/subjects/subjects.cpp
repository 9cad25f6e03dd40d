#include "fuzz/subjects/subjects.hpp"

#include <string>

#include "ccd/plugin.hpp"
#include "fuzz/subjects/peers.hpp"

namespace nearmiss {

namespace {

std::unique_ptr<Subject> make_built_in_or_refuse(std::string_view name, std::optional<double> given_bound) {
  auto subject = try_make_built_in(name, given_bound);
  if (subject) return subject;
  auto known = built_in_subjects();
  for (const Peer& peer : peers()) known.push_back({.name = peer.name, .about = {}});
  refuse_subject(name, known);
}

}  // namespace

std::optional<std::string> plugin_named(std::string_view name) {
  return is_plugin(name) ? std::string(name) : plugin_of_peer(name);
}

std::unique_ptr<Subject> make_any_subject(std::string_view name, std::optional<double> given_bound,
                                          const isolation::PluginLimits& limits) {
  if (const auto plugin = plugin_named(name)) return make_isolated_plugin(*plugin, limits);
  return make_built_in_or_refuse(name, given_bound);
}

std::vector<std::unique_ptr<Subject>> make_any_subjects(std::string_view name,
                                                        std::optional<double> given_bound,
                                                        const isolation::PluginLimits& limits) {
  if (const auto plugin = plugin_named(name)) return make_isolated_plugins(*plugin, limits);
  std::vector<std::unique_ptr<Subject>> subjects;
  subjects.push_back(make_built_in_or_refuse(name, given_bound));
  return subjects;
}

}  // namespace nearmiss
