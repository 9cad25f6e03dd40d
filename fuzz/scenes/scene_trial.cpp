#include "fuzz/scenes/scene_trial.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
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
  reported.insert(reported.end(), other.reported.begin(), other.reported.end());
  counts.merge(other.counts);
}

SceneTrial::PartResult SceneTrial::hold_parts(std::size_t step, const MovingMesh& mesh,
                                              const std::function<void(double)>& progress,
                                              const IsAsked& is_asked) {
  PartResult sum;
  make_plan(mesh);
  const auto parts = static_cast<double>(plan_->parts());
  trials_.run([&, begun = std::size_t{0}]() mutable -> std::optional<Work> {
    if (begun == plan_->parts()) return std::nullopt;
    const std::size_t number = begun++;
    const auto part = std::make_shared<PartResult>();
    return Work{[=, this, &is_asked](const AskBatch& ask) { *part = hold_part(step, number, ask, is_asked); },
                [=, &sum, &progress](bool /*complete*/) {
                  sum.merge(*part);
                  progress(static_cast<double>(number + 1) / parts);
                  return true;
                }};
  });
  return sum;
}

void SceneTrial::hold(std::size_t step, const MovingMesh& mesh, const std::function<void(double)>& progress) {
  try {
    const PartResult sum = hold_parts(step, mesh, progress, {});
    TrialResult counted;
    for (const Funnels& funnels :
         {sum.funnels, trials_.stop().is_due() ? Funnels{} : plan_->rest(sum.funnels)})
      for (const auto& [kind, funnel] : funnels)
        counted.statistics.funnels[{step_name(scene_, step), kind}].merge(funnel);
    trials_.add(std::move(counted));
    add_picture(step, mesh, sum.marks);
  } catch (const Stopped&) {
    plan_.reset();
  }
}

void SceneTrial::add_picture(std::size_t step, const MovingMesh& mesh, const Marks& marks) {
  constexpr std::size_t most_pictures = 5;  // a picture of a large mesh takes up to 0.5 MB
  const std::array rank{marks.missed(), marks.size()};
  const auto place = std::find_if(pictures_.begin(), pictures_.end(),
                                  [&](const RankedPicture& each) { return each.rank < rank; });
  if (marks.size() == 0 || place - pictures_.begin() == most_pictures) return;
  std::vector<std::string> names;
  for (const auto& subject : trials_.subjects()) names.push_back(subject->name());
  pictures_.insert(place, {rank, step, marks.picture(step_name(scene_, step), mesh, names)});
  if (pictures_.size() > most_pictures) pictures_.pop_back();
}

std::vector<ScenePicture> SceneTrial::pictures() const {
  std::map<std::size_t, ScenePicture> by_step;
  for (const RankedPicture& each : pictures_) by_step.emplace(each.step, each.picture);
  std::vector<ScenePicture> pictures;
  for (auto& [step, picture] : by_step) pictures.push_back(std::move(picture));
  return pictures;
}

std::vector<ReportedPair> SceneTrial::ask(std::size_t step, const MovingMesh& mesh, const IsAsked& is_asked,
                                          SimulatedStep& counts) {
  PartResult sum = hold_parts(
      step, mesh, [](double /*part*/) {}, is_asked);
  trials_.stop().check();
  counts.merge(sum.counts);
  return std::move(sum.reported);
}

SceneTrial::PartResult SceneTrial::hold_part(std::size_t step, std::size_t number, const AskBatch& ask,
                                             const IsAsked& is_asked) const {
  const std::string name = step_name(scene_, step);
  PartResult part;
  const auto keep = [&](const Candidate& pair, const Outcome& outcome) {
    const Verdict& verdict = outcome.verdict;
    if (verdict.fault != Fault::none) return;
    ++part.counts.queries;
    --part.counts.unanswered;
    part.counts.collisions += outcome.collision ? 1 : 0;
    part.counts.positives += verdict.hit ? 1 : 0;
    part.counts.false_negatives += outcome.collision && !verdict.hit ? 1 : 0;
    part.counts.false_positives += verdict.hit && !outcome.collision ? 1 : 0;
    if (verdict.hit) part.reported.push_back({pair, verdict.time});
  };
  const auto ask_pairs = [&](const AskedPairs& pairs) {
    ask({.kind = pairs.kind,
         .family = is_asked ? scene_family(scene_) : name,
         .queries = pairs.queries,
         .first_number = (std::uint64_t{step} << 48) + (std::uint64_t{number} << 24),
         .provenance =
             [&](std::size_t i) {
               return fmt::format("{}:{}:{}", name, short_name(pairs.kind),
                                  fmt::join(pairs.candidates[i].vertices, ","));
             },
         .observe =
             [&](std::size_t i, std::size_t subject, const Outcome& outcome) {
               if (is_asked)
                 keep(pairs.candidates[i], outcome);
               else
                 part.marks.add(pairs.candidates[i], subject, outcome);
             }});
  };
  const auto ask_some = [&](const AskedPairs& pairs) {
    AskedPairs some{.kind = pairs.kind, .candidates = {}, .queries = {}};
    for (std::size_t i = 0; i < pairs.candidates.size(); ++i)
      if (is_asked(pairs.candidates[i])) {
        some.candidates.push_back(pairs.candidates[i]);
        some.queries.push_back(pairs.queries[i]);
      }
    part.counts.unanswered += some.queries.size();
    if (!some.queries.empty()) ask_pairs(some);
  };
  const auto decided = [&](const Candidate& candidate, const Query&, PairFate, bool collides) {
    if (collides) part.marks.add_collision(candidate);
  };
  part.funnels = plan_->follow(number, is_asked ? AskSink(ask_some) : AskSink(ask_pairs), decided,
                               [&] { return trials_.stop().is_due(); });
  return part;
}

}  // namespace nearmiss
