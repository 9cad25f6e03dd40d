#include "fuzz/subjects/recorded.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "ccd/nearmiss_subject.h"
#include "ccd/subjects/described_subject.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

namespace {

/// Whether double represents the sum a + b exactly (Knuth's TwoSum). The sum must not overflow.
bool is_exact_sum(double a, double b) {
  const double sum = a + b;
  const double of_b = sum - a;
  return (a - (sum - of_b)) + (b - of_b) == 0;
}

/// Whether Recorded::asked() computes all positions exactly.
bool is_exact(const Recorded& each) {
  if (each.tmax == 1) return true;
  constexpr std::size_t half = 12;
  for (std::size_t i = 0; i < half; ++i) {
    const double start = each.query.x[i];
    const double motion = each.query.x[half + i] - start;
    const double part = each.tmax * motion;
    if (!is_exact_sum(each.query.x[half + i], -start) || std::fma(each.tmax, motion, -part) != 0 ||
        !is_exact_sum(start, part))
      return false;
  }
  return true;
}

/// Whether the query that ends at tmax has the same decision with and without rounding of the positions at
/// tmax.
bool is_same_decision(const Recorded& each) {
  auto earliest = earliest_time(each.query);
  return earliest_time(each.asked()).has_value() == (earliest && earliest->enclosure().hi <= each.tmax);
}

/// The time divided by tmax, rounded down, so that rounding does not make the time later.
double part_of(double time, double tmax) {
  const double part = time / tmax;
  return std::fma(part, tmax, -time) > 0 ? std::nextafter(part, 0.0) : part;
}

/// The answer of a record in the form in which it is judged; nothing if it cannot be judged.
std::optional<RecordedAnswer> judgeable(const std::filesystem::path& file, const Recorded& each) {
  const bool has_time = each.answer == NEARMISS_COLLISION && !std::isnan(each.time);
  RecordedAnswer judged{
      file, each.number, each.query, each.answer, has_time ? each.time : std::nan(""), each.is_float};
  if (each.tmax == 1 || (each.tmax < 1 && has_time)) return judged;
  const bool exact = is_exact(each);
  if (!exact && (each.tmax > 1 || !is_same_decision(each))) return std::nullopt;
  judged.query = each.asked();
  judged.time = part_of(judged.time, each.tmax);
  judged.in_float = false;
  return judged;
}

struct Order {
  bool operator()(const Query& one, const Query& other) const {
    return std::tie(one.kind, one.x, one.separation) < std::tie(other.kind, other.x, other.separation);
  }
};
using Answers = std::map<Query, Verdict, Order>;

class RecordedSubject final : public DescribedSubject {
 public:
  RecordedSubject(DetectorInfo info, Answers answers)
      : DescribedSubject(std::move(info)), answers_(std::move(answers)) {}

  using DescribedSubject::decide;
  void decide(std::span<const Query> queries, std::span<Verdict> verdicts) const override {
    std::ranges::transform(queries, verdicts.begin(), [&](const Query& query) {
      const auto found = answers_.find(query);
      return found == answers_.end() ? Verdict{.fault = Fault::not_asked} : found->second;
    });
  }
  [[nodiscard]] BoundAnswer ask_bound(const Query& /*query*/) const override {
    return BoundAnswer::given(HUGE_VAL);  // claims no bound
  }

 private:
  Answers answers_;
};

/// The recorded answer as a verdict. A collision may lack a time even if other answers have times.
Verdict verdict_of(const DetectorInfo& info, const RecordedAnswer& each) {
  if (each.answer == NEARMISS_COLLISION && std::isnan(each.time))
    return Verdict::accepted(Stage::unspecified, each.time);
  return nearmiss::verdict_of(info, each.answer, each.time);
}

bool is_same(const Verdict& one, const Verdict& other) {
  return one.hit == other.hit && one.fault == other.fault && one.stage == other.stage &&
         (one.time == other.time || (std::isnan(one.time) && std::isnan(other.time)));
}

}  // namespace

LeftOut read_judgeable(const std::filesystem::path& file, const std::function<void(RecordedAnswer&&)>& sink) {
  LeftOut left;
  left.unused = read_recording(file, [&](const Recorded& each) {
    if (auto judged = judgeable(file, each))
      sink(std::move(*judged));
    else
      ++left.rounded;
  });
  return left;
}

std::vector<RecordedPass> in_passes(std::vector<RecordedAnswer> answers) {
  DetectorInfo info{.name = std::string(recorded_name)};
  info.kinds = info.separation_kinds = bits_of_all_kinds;
  const bool has_times =
      std::ranges::any_of(answers, [](const auto& each) { return !std::isnan(each.time); });
  info.time_sort = has_times ? TimeSort::lower_bound : TimeSort::none;
  struct Made {
    Answers known;
    std::vector<RecordedAnswer> answers;
  };
  // The first element has the passes of the answers in double, and the second has the passes of the answers
  // in float.
  std::array<std::vector<Made>, 2> made;
  for (RecordedAnswer& each : answers) {
    auto& passes = made[each.in_float ? 1 : 0];
    const Verdict verdict = verdict_of(info, each);
    const auto fits = [&](Made& pass) {
      return is_same(pass.known.try_emplace(each.query, verdict).first->second, verdict);
    };
    auto pass = std::ranges::find_if(passes, fits);
    if (pass == passes.end()) {
      passes.emplace_back().known.emplace(each.query, verdict);
      pass = std::prev(passes.end());
    }
    pass->answers.push_back(std::move(each));
  }
  std::vector<RecordedPass> passes;
  for (const bool in_float : {false, true})
    for (Made& pass : made[in_float ? 1 : 0]) {
      info.is_narrow = in_float;
      passes.push_back(
          {std::make_unique<RecordedSubject>(info, std::move(pass.known)), std::move(pass.answers)});
    }
  return passes;
}

}  // namespace nearmiss
