#include "fuzz/subjects/subjects.hpp"

#include <string>

#include "ccd/plugin.hpp"

namespace nearmiss {

std::unique_ptr<Subject> make_any_subject(std::string_view name_or_path, std::optional<double> given_bound,
                                          const isolation::PluginLimits& limits) {
  if (is_plugin_path(name_or_path)) return make_isolated_plugin(std::string(name_or_path), limits);
  return make_built_in(name_or_path, given_bound);
}

}  // namespace nearmiss
