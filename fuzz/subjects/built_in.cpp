#include "fuzz/subjects/built_in.hpp"

#include "fuzz/subjects/defects.hpp"
#include "fuzz/subjects/exact.hpp"
#include "fuzz/subjects/ladder/adaptive.hpp"
#include "fuzz/subjects/ladder/scalars.hpp"

namespace nearmiss {

std::vector<SubjectInfo> built_in_subjects() {
  auto infos = subjects();
  const auto exact = exact_subjects();
  infos.insert(infos.end(), exact.begin(), exact.end());
  infos.push_back(adaptive_info);
  infos.push_back(parity_info);
  infos.push_back(dd_normals_info);
  return infos;
}

std::unique_ptr<Subject> try_make_built_in(std::string_view name, std::optional<double> given_bound) {
  if (auto defect = try_make_defect(name)) return defect;
  if (auto exact = try_make_exact(name)) return exact;
  if (auto adaptive = try_make_adaptive(name)) return adaptive;
  if (auto scaled = try_make_scaled(name, given_bound)) return scaled;
  return try_make_subject(name, given_bound);
}

std::unique_ptr<Subject> make_built_in(std::string_view name, std::optional<double> given_bound) {
  auto subject = try_make_built_in(name, given_bound);
  if (!subject) refuse_subject(name, built_in_subjects());
  return subject;
}

}  // namespace nearmiss
