#include "fuzz/questions/step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "corpus/query_text.hpp"
#include "fuzz/families/contacts.hpp"
#include "fuzz/questions/distance.hpp"
#include "fuzz/questions/question_trial.hpp"
#include "fuzz/search/maximiser.hpp"
#include "fuzz/search/search.hpp"
#include "fuzz/trial/signatures.hpp"
#include "oracle/certificates/certificate.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

namespace {

/// The query, with its positions at t = 1 replaced by y.
Query to_positions(const Query& query, const std::array<double, 12>& y) {
  Query step = query;
  std::copy_n(y.begin(), 3 * vertices(query.kind), step.x.begin() + 12);
  repeat_vertices(step);
  return step;
}

/// The part of the motion of `whole` that the motion of `step` covers, rounded. Both motions are first
/// divided by the largest component of the motion of `whole`, so that no product overflows or vanishes.
double part_of(const Query& step, const Query& whole) {
  double largest = 0;
  const auto motion = [](const Query& query, std::size_t i) { return query.x[12 + i] / 2 - query.x[i] / 2; };
  for (std::size_t i = 0; i < 12; ++i) largest = std::max(largest, std::abs(motion(whole, i)));
  if (largest == 0) return 1;
  double along = 0;
  double squared = 0;
  for (std::size_t i = 0; i < 12; ++i) {
    const double own = motion(whole, i) / largest;
    along += motion(step, i) / largest * own;
    squared += own * own;
  }
  return along / squared;
}

}  // namespace

std::optional<std::string_view> StepQuestion::Judged::failure() const {
  if (answer.fault != Fault::none) return "fault";
  if (touches) return "unsafe";
  return std::nullopt;
}

std::string StepQuestion::Judged::answer_text() const {
  std::string text = to_hex(answer.clearance);
  for (int i = 0; i < 3 * vertices(query.kind); ++i)
    text += " " + to_hex(answer.y[static_cast<std::size_t>(i)]);
  return text;
}

std::string StepQuestion::Judged::text() const {
  if (!touches) return std::string(word());
  auto earliest = earliest_time(step);
  const double time = earliest ? earliest->enclosure(rough_time).lo : 0;
  if (step.separation == 0) return fmt::format("unsafe: contact at t = {:.4g} of the filtered step", time);
  return fmt::format("unsafe: nearer than the clearance {:.6g} from t = {:.4g} of the filtered step on",
                     step.separation, time);
}

std::string StepQuestion::Judged::certificate() const {
  if (!touches) return "";
  return certify_meets(step, {}, step.separation > 0).value_or("");
}

void StepQuestion::Counts::add(const Judged& judged, QueryClass of,
                               const std::function<std::string()>& provenance) {
  ++queries;
  const auto index = static_cast<std::size_t>(of);
  if (judged.answer.fault != Fault::none) {
    ++faults_by_class[index];
    return;
  }
  unsafe_by_class[index] += judged.touches ? 1 : 0;
  cut_free += judged.cuts_free ? 1 : 0;
  objects += judged.objects ? 1 : 0;
  constexpr double rounding = 1e-6;  // in percent; above the error of `kept`
  ++kept[static_cast<std::size_t>(std::min(100 * judged.kept + rounding, 100.0))];
  if (judged.kept < 1) keep_farthest(least_kept, 1 - judged.kept, judged.query, provenance);
}

std::uint64_t StepQuestion::Counts::failures() const {
  return sum_that_counts(unsafe_by_class) + sum_that_counts(faults_by_class);
}

std::optional<StepQuestion::Judged> StepQuestion::ask(const Subject& subject, const Query& query) {
  Judged judged{.query = subject.rounded(nearmiss::with_separation(query, 0)), .answer = {}};
  if (collides(at_rest(judged.query))) return std::nullopt;
  judged.answer = subject.ask_step(judged.query);
  const Fault fault = judged.answer.fault;
  if (fault == Fault::contract || fault == Fault::not_asked) return std::nullopt;
  if (fault != Fault::none) return judged;
  judged.step =
      nearmiss::with_separation(to_positions(judged.query, judged.answer.y), judged.answer.clearance);
  judged.touches = decide(judged.step).collision;
  const double along = part_of(judged.step, judged.query);
  auto contact = earliest_time(judged.query);
  const double safe = contact ? contact->enclosure(rough_time).lo : 1;
  judged.kept = safe > 0 ? std::clamp(along / safe, 0.0, 1.0) : 1;
  judged.cuts_free = !contact && judged.step.x != judged.query.x;
  const StepAnswer again = subject.ask_step(nearmiss::with_separation(judged.step, 0));
  judged.objects = again.fault == Fault::none && to_positions(judged.step, again.y).x != judged.step.x;
  return judged;
}

std::string StepQuestion::signature(const Subject& subject, const Judged& judged) {
  if (judged.answer.fault == Fault::none) return contact_signature(judged.step);
  return fault_signature(subject, judged.query.kind, judged.answer.fault, judged.answer.fault_code);
}

namespace {

Query search_step(const Subject& subject, const Stop& stop, Random& random, Kind kind) {
  const auto objective = [&](const SearchPoint& point) {
    stop.check();
    const Query query = query_of(kind, point, 0);
    if (!is_finite(query)) return unwanted;
    const auto judged = StepQuestion::ask(subject, query);
    if (!judged) return unwanted;
    if (judged->failure()) return HUGE_VAL;
    const double left = minimum_distance(judged->step).hi - judged->step.separation;
    const double size = extent(judged->query);
    return left > 0 && size > 0 ? -std::log2(left / size) : unwanted / 2;
  };
  const auto draw = [&] { return draw_search_point(random, usually_smallest); };
  return query_of(
      kind, Maximiser(random, false, usually_smallest, objective, /*moves_vertices=*/true).run(draw), 0);
}

}  // namespace

std::vector<Family> StepQuestion::searches(const Subject& subject, const Stop& stop) {
  return search_families("search-step-" + subject.name(),
                         "filtered steps that come nearest to contact, by directed search",
                         [&](Random& random, Kind kind) { return search_step(subject, stop, random, kind); });
}

}  // namespace nearmiss
