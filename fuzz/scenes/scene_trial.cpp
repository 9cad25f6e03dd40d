#include "fuzz/scenes/scene_trial.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "corpus/query_text.hpp"

namespace nearmiss {

void SceneTrial::make_plan(const MovingMesh& mesh) {
  const IsOver is_over = [&] { return trials_.stop().is_due(); };
  if (plan_)
    plan_->move(mesh, trials_.jobs(), is_over);
  else
    plan_.emplace(mesh, leave_out_, trials_.jobs(), is_over);
}

void SceneTrial::hold(std::size_t step, const MovingMesh& mesh, const std::function<void(double)>& progress) {
  try {
    make_plan(mesh);
  } catch (const Stopped&) {
    plan_.reset();
    return;
  }
  const std::string name = step_name(scene_, step);
  PartResult sum;
  for (std::size_t first = 0; first < plan_->parts() && !trials_.stop().is_due();) {
    std::vector<PartResult> parts(std::min(trials_.at_once(), plan_->parts() - first));
    sink_(trials_.hold(parts.size(), [&](std::size_t i) { return hold_part(step, first + i, parts[i]); }));
    for (const PartResult& part : parts) {
      for (const auto& [kind, funnel] : part.funnels) sum.funnels[kind].merge(funnel);
      sum.marks.merge(part.marks);
    }
    first += parts.size();
    progress(static_cast<double>(first) / static_cast<double>(plan_->parts()));
  }
  TrialResult counted;
  for (const Funnels& funnels : {sum.funnels, trials_.stop().is_due() ? Funnels{} : plan_->rest(sum.funnels)})
    for (const auto& [kind, funnel] : funnels) counted.statistics.funnels[{name, kind}].merge(funnel);
  sink_(std::move(counted));
  if (sum.marks.size() > marks_.size()) {
    most_marked_ = step;
    marks_ = std::move(sum.marks);
  }
}

std::optional<ScenePicture> SceneTrial::picture() const {
  if (marks_.size() == 0) return std::nullopt;
  std::vector<std::string> names;
  for (const auto& subject : trials_.subjects()) names.push_back(subject->name());
  return marks_.picture(step_name(scene_, most_marked_), moving_mesh(scene_, most_marked_), names);
}

TrialResult SceneTrial::hold_part(std::size_t step, std::size_t number, PartResult& part) const {
  const std::string name = step_name(scene_, step);
  TrialResult result;
  const auto ask = [&](const AskedPairs& pairs) {
    const Batch batch{
        .kind = pairs.kind,
        .family = name,
        .queries = pairs.queries,
        .first_number = (std::uint64_t{step} << 48) + (std::uint64_t{number} << 24),
        .provenance =
            [&](std::size_t i) {
              return fmt::format("{}:{}:{}", name, short_name(pairs.kind),
                                 fmt::join(pairs.candidates[i].vertices, ","));
            },
        .observe = [&](std::size_t i, std::size_t subject,
                       const Outcome& outcome) { part.marks.add(pairs.candidates[i], subject, outcome); }};
    result.merge(trials_.trial(batch));
  };
  const auto decided = [&](const Candidate& candidate, const Query&, PairFate, bool collides) {
    if (collides) part.marks.add_collision(candidate);
  };
  part.funnels = plan_->follow(number, ask, decided, [&] { return trials_.stop().is_due(); });
  return result;
}

}  // namespace nearmiss
