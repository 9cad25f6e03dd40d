#include "fuzz/scenes/scene_trial.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <string>
#include <utility>
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

void SceneTrial::PartResult::merge(const PartResult& other) {
  for (const auto& [kind, funnel] : other.funnels) funnels[kind].merge(funnel);
  marks.merge(other.marks);
}

void SceneTrial::hold(std::size_t step, const MovingMesh& mesh, const std::function<void(double)>& progress) {
  try {
    make_plan(mesh);
  } catch (const Stopped&) {
    plan_.reset();
    return;
  }
  PartResult sum;
  const auto parts = static_cast<double>(plan_->parts());
  trials_.run([&, begun = std::size_t{0}]() mutable -> std::optional<Work> {
    if (begun == plan_->parts()) return std::nullopt;
    const std::size_t number = begun++;
    const auto part = std::make_shared<PartResult>();
    return Work{[=, this](const AskBatch& ask) { *part = hold_part(step, number, ask); },
                [=, &sum, &progress](bool /*complete*/) {
                  sum.merge(*part);
                  progress(static_cast<double>(number + 1) / parts);
                  return true;
                }};
  });
  TrialResult counted;
  for (const Funnels& funnels : {sum.funnels, trials_.stop().is_due() ? Funnels{} : plan_->rest(sum.funnels)})
    for (const auto& [kind, funnel] : funnels)
      counted.statistics.funnels[{step_name(scene_, step), kind}].merge(funnel);
  trials_.add(std::move(counted));
  if (sum.marks.size() <= most_marks_) return;
  most_marks_ = sum.marks.size();
  std::vector<std::string> names;
  for (const auto& subject : trials_.subjects()) names.push_back(subject->name());
  picture_ = sum.marks.picture(step_name(scene_, step), mesh, names);
}

SceneTrial::PartResult SceneTrial::hold_part(std::size_t step, std::size_t number,
                                             const AskBatch& ask) const {
  const std::string name = step_name(scene_, step);
  PartResult part;
  const auto ask_pairs = [&](const AskedPairs& pairs) {
    ask({.kind = pairs.kind,
         .family = name,
         .queries = pairs.queries,
         .first_number = (std::uint64_t{step} << 48) + (std::uint64_t{number} << 24),
         .provenance =
             [&](std::size_t i) {
               return fmt::format("{}:{}:{}", name, short_name(pairs.kind),
                                  fmt::join(pairs.candidates[i].vertices, ","));
             },
         .observe = [&](std::size_t i, std::size_t subject,
                        const Outcome& outcome) { part.marks.add(pairs.candidates[i], subject, outcome); }});
  };
  const auto decided = [&](const Candidate& candidate, const Query&, PairFate, bool collides) {
    if (collides) part.marks.add_collision(candidate);
  };
  part.funnels = plan_->follow(number, ask_pairs, decided, [&] { return trials_.stop().is_due(); });
  return part;
}

}  // namespace nearmiss
