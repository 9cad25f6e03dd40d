#include "fuzz/scenes/scene_trial.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "corpus/query_text.hpp"
#include "fuzz/parallel.hpp"

namespace nearmiss {

SceneTrial::SceneTrial(const Subjects& subjects, const Comparison& comparison, int jobs,
                       const std::atomic<bool>& stop, Sink sink)
    : subjects_(subjects),
      comparison_(comparison),
      jobs_(jobs),
      stop_(stop),
      sink_(std::move(sink)),
      sieve_(subjects, jobs, stop) {}

void SceneTrial::hold(const std::string& name, const MovingMesh& mesh, LeaveOut leave_out,
                      const std::function<void(double)>& progress) {
  const Plan plan(mesh, leave_out);
  const std::size_t at_once = 4 * static_cast<std::size_t>(jobs_);
  Funnels parts;
  Marks marks;
  for (std::size_t first = 0; first < plan.parts() && !stop_; first += at_once) {
    std::vector<PartResult> results(std::min(at_once, plan.parts() - first));
    in_parallel(jobs_, results.size(), [&](std::size_t i) { results[i] = hold_part(name, plan, first + i); });
    PartResult sum;
    for (PartResult& each : results) {
      for (const auto& [kind, funnel] : each.funnels) parts[kind].merge(funnel);
      marks.merge(each.marks);
      sum.trial.merge(std::move(each.trial));
    }
    sieve_.sift(sum.trial.findings);
    sink_(std::move(sum.trial));
    progress(static_cast<double>(first + results.size()) / static_cast<double>(plan.parts()));
  }
  if (marks.size() > most_marks_) {
    most_marks_ = marks.size();
    std::vector<std::string> names;
    for (const auto& subject : subjects_) names.push_back(subject->name());
    picture_ = marks.picture(name, mesh, names);
  }
  TrialResult counted;
  for (const Funnels& funnels : {parts, stop_ ? Funnels{} : plan.rest(parts)})
    for (const auto& [kind, funnel] : funnels) counted.statistics.funnels[{name, kind}].merge(funnel);
  sink_(std::move(counted));
}

SceneTrial::PartResult SceneTrial::hold_part(const std::string& name, const Plan& plan,
                                             std::size_t part) const {
  PartResult result;
  const auto ask = [&](const Pairs& pairs) {
    const Batch batch{
        .kind = pairs.kind,
        .family = name,
        .queries = pairs.queries,
        .provenance =
            [&](std::size_t i) {
              return fmt::format("{}:{}:{}", name, short_name(pairs.kind),
                                 fmt::join(pairs.candidates[i].vertices, ","));
            },
        .observe = [&](std::size_t i, std::size_t subject,
                       const Outcome& outcome) { result.marks.add(pairs.candidates[i], subject, outcome); }};
    result.trial.merge(hold_trial(subjects_, batch, comparison_));
  };
  const auto decided = [&](const Candidate& candidate, const Query&, PairFate, bool collides) {
    if (collides) result.marks.add_collision(candidate);
  };
  result.funnels = plan.follow(part, ask, decided, [&] { return stop_.load(); });
  return result;
}

}  // namespace nearmiss
