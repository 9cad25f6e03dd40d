#include "tools/scene_subjects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "ccd/query/error.hpp"
#include "corpus/query_text.hpp"
#include "fuzz/scenes/built_in/built_in_scenes.hpp"
#include "fuzz/scenes/claimed_precision.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "reports/text/text.hpp"

namespace nearmiss::tools {

Scene open_scene(const std::vector<std::string>& arguments) {
  if (arguments.size() == 2) return scene_of_files(arguments[0], arguments[1]);
  if (is_built_in_scene(arguments[0])) return built_in_scene(arguments[0]);
  if (std::error_code error; !std::filesystem::exists(arguments[0], error))
    throw Error(fmt::format(
        "{}: found neither a folder nor a scene with this name (see nearmiss scene --list)", arguments[0]));
  return scene_of_folder(arguments[0]);
}

namespace {

bool uses_bound(const std::string& text) {
  Query query;
  query.x[0] = 1;
  return make_any_subject(text)->distance_bound(query) != make_any_subject(text, 1e3)->distance_bound(query);
}

}  // namespace

SceneSubjects scene_subjects(const TrialOptions& trial, const std::vector<std::string>& bounds,
                             const Scene& scene, const Stop& stop) {
  SceneSubjects all;
  Subjects made;
  std::set<std::string> texts;
  const auto add = [&](const std::string& text) {
    if (!texts.insert(text).second) return;
    const auto bound = text.ends_with(of_scene) ? all.bound : std::nullopt;
    for (auto& subject : make_any_subjects(text, bound, trial.plugin_limits(stop)))
      made.push_back(std::move(subject));
  };
  for (const std::string& bound : bounds) {
    if (bound == "scene" && !all.bound) all.bound = scene_bound(scene);
    const std::string suffix = bound == "pair"    ? ""
                               : bound == "scene" ? std::string(of_scene)
                                                  : fmt::format("@{}", *parse_bound(bound));
    for (const std::string& text : trial.subjects)
      add(plugin_named(text) || (!suffix.empty() && !uses_bound(text)) ? text : text + suffix);
  }
  tell_apart(made);
  all.subjects = trial.keep_contracts(std::move(made));
  return all;
}

void keep_cheapest_within(const std::string& thickness, const Scene& scene, LeaveOut leave_out,
                          Subjects& subjects, std::FILE* out) {
  const double limit = parse_number(thickness, "--thickness");
  const auto all = claimed_precisions(scene, leave_out, subjects);
  if (std::ranges::all_of(all, [](const ClaimedPrecision& each) { return each.ns_per_query == 0; }))
    return fmt::print(out, "contact thickness {:g}: no pair needs a subject\n", limit);
  const ClaimedPrecision* const best = cheapest_within(all, limit);
  std::vector<std::vector<std::string>> rows{{"subject", "claimed distance", "ns/query", ""}};
  for (const ClaimedPrecision& each : all)
    rows.push_back({each.subject, fmt::format("{:.3g}", each.claimed),
                    fmt::format("{:.0f}", each.ns_per_query),
                    &each == best ? "the cheapest within the thickness"
                                  : (each.claimed <= limit ? "" : "more than the thickness")});
  fmt::print(out, "contact thickness {:g}\n{}\n", limit, columns(rows, 1));
  if (best == nullptr)
    throw Error(fmt::format("--thickness: found {}, which is less than every subject claims", thickness));
  std::erase_if(subjects, [&](const auto& each) { return each->name() != best->subject; });
}

}  // namespace nearmiss::tools
