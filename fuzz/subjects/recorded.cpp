#include "fuzz/subjects/recorded.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "ccd/nearmiss_subject.h"
#include "ccd/subjects/described_subject.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

namespace {

/// Whether a sum is exact (Knuth's TwoSum), if it does not overflow.
bool is_exact_sum(double a, double b) {
  const double sum = a + b;
  const double of_b = sum - a;
  return (a - (sum - of_b)) + (b - of_b) == 0;
}

/// Whether Recorded::asked() is exact.
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

/// Whether the query that ends at tmax, rounded, is decided as the exact one.
bool is_same_decision(const Recorded& each) {
  auto earliest = earliest_time(each.query);
  return collides(each.asked()) == (earliest && earliest->enclosure().hi <= each.tmax);
}

/// A time as a part of [0, tmax]. A quotient that no double holds is rounded down, so that it is no later.
double part_of(double time, double tmax) {
  const double part = time / tmax;
  return std::fma(part, tmax, -time) > 0 ? std::nextafter(part, 0.0) : part;
}

/// What can be judged of a record.
std::optional<RecordedAnswer> judgeable(const Recorded& each) {
  RecordedAnswer judged{each.number, each.asked(), each.answer, part_of(each.time, each.tmax)};
  if (is_exact(each)) return judged;
  if (each.tmax > 1) return std::nullopt;
  if (each.answer == NEARMISS_COLLISION) {
    judged.query = each.query;
    judged.time = each.time;
    return judged;
  }
  return is_same_decision(each) ? std::optional(judged) : std::nullopt;
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
    return BoundAnswer::given(HUGE_VAL);  // it claims none
  }

 private:
  Answers answers_;
};

}  // namespace

LeftOut read_judgeable(const std::filesystem::path& file, const std::function<void(RecordedAnswer&&)>& sink) {
  LeftOut left;
  left.unused = read_recording(file, [&](const Recorded& each) {
    if (auto judged = judgeable(each))
      sink(std::move(*judged));
    else
      ++left.rounded;
  });
  return left;
}

std::unique_ptr<Subject> recorded_answers(std::span<const RecordedAnswer> all) {
  const bool has_times = std::ranges::all_of(all, [](const RecordedAnswer& each) {
    return each.answer != NEARMISS_COLLISION || !std::isnan(each.time);
  });
  DetectorInfo info{.name = std::string(recorded_name)};
  info.kinds = info.separation_kinds = bits_of_all_kinds;
  info.time_sort = has_times ? TimeSort::lower_bound : TimeSort::none;
  Answers answers;
  for (const RecordedAnswer& each : all) {
    const Verdict verdict = verdict_of(info, each.answer, each.time);
    const auto [place, is_new] = answers.try_emplace(each.query, verdict);
    const bool is_same = place->second.hit == verdict.hit && place->second.fault == verdict.fault;
    if (!is_new && !is_same) place->second = {.fault = Fault::inconsistent};
  }
  return std::make_unique<RecordedSubject>(std::move(info), std::move(answers));
}

}  // namespace nearmiss
