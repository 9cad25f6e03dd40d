#include "fuzz/subjects/subjects.hpp"

#include "ccd/plugin.hpp"
#include "fuzz/subjects/defects.hpp"
#include "fuzz/subjects/ladder/adaptive.hpp"
#include "fuzz/subjects/ladder/scalars.hpp"
#include "oracle/subjects.hpp"

namespace nearmiss {

std::vector<SubjectInfo> all_subjects() {
  auto infos = subjects();
  const auto exact = exact_subjects();
  infos.insert(infos.end(), exact.begin(), exact.end());
  infos.push_back(adaptive_info);
  return infos;
}

std::unique_ptr<Subject> make_any_subject(std::string_view name_or_path, std::optional<double> given_bound,
                                          const isolation::PluginLimits& limits) {
  if (is_plugin_path(name_or_path)) return make_isolated_plugin(std::string(name_or_path), limits);
  if (auto defect = try_make_defect(name_or_path)) return defect;
  if (auto exact = try_make_exact(name_or_path)) return exact;
  if (auto adaptive = try_make_adaptive(name_or_path)) return adaptive;
  if (auto scaled = try_make_scaled(name_or_path, given_bound)) return scaled;
  auto subject = try_make_subject(name_or_path, given_bound);
  if (!subject) refuse_subject(name_or_path, all_subjects());
  return subject;
}

}  // namespace nearmiss
