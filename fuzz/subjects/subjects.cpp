#include "fuzz/subjects/subjects.hpp"

#include <string>

#include "ccd/plugin.hpp"

namespace nearmiss {

std::unique_ptr<Subject> make_any_subject(std::string_view name, std::optional<double> given_bound,
                                          const isolation::PluginLimits& limits) {
  if (is_plugin(name)) return make_isolated_plugin(std::string(name), limits);
  return make_built_in(name, given_bound);
}

std::vector<std::unique_ptr<Subject>> make_any_subjects(std::string_view name,
                                                        std::optional<double> given_bound,
                                                        const isolation::PluginLimits& limits) {
  if (is_plugin(name)) return make_isolated_plugins(std::string(name), limits);
  std::vector<std::unique_ptr<Subject>> subjects;
  subjects.push_back(make_built_in(name, given_bound));
  return subjects;
}

}  // namespace nearmiss
